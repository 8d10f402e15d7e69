#include "ground/feed/feed.hpp"

#include <ctime>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/feed/video_output.hpp"
#include "ground/interrupt.hpp"
#include "hal/recorded/recorded_camera.hpp"
#include "hal/shared_frames/shared_frames.hpp"

namespace omma::ground {
namespace {

struct FeedOptions {
  std::string recording;
  std::vector<std::string> cameras;  // CAMERA=DEVICE
  std::string log;
  double rate_hz = 10;
  std::uint64_t frames = 0;
  int rounds = 1;
};

constexpr std::string_view kShared = "simulated:";

struct FedCamera {
  std::string name;
  std::string device;
  std::vector<Image> images;
  std::vector<std::uint64_t> numbers;
  std::unique_ptr<VideoOutput> output;
  std::unique_ptr<SharedFramesWriter> shared;  // instead

  void open() {
    const ImageView first = images.front().view();
    if (device.rfind(kShared, 0) != 0) {
      output = std::make_unique<VideoOutput>(device, first);
      return;
    }
    shared = std::make_unique<SharedFramesWriter>(
        device.substr(kShared.size()), GreyShape{first.width, first.height, first.format, first.white_level});
  }
  void give(std::size_t frame, TimeNs now) const {
    const ImageView image = images[frame].view();
    if (shared) {
      shared->write(image.data, now);
    } else {
      output->write(image);
    }
  }
  // What the reader has set.
  void print_settings() const {
    const std::int64_t exposure =
        shared ? shared->exposure_us() : output->control("exposure_time_absolute", 0);
    const std::int64_t gain = shared ? shared->gain_percent() : output->control("analogue_gain", 0);
    std::printf("%s: its reader asks for exposure %lld, gain %lld\n", name.c_str(),
                static_cast<long long>(exposure), static_cast<long long>(gain));
  }
};

FedCamera read_camera(const FeedOptions& options, const std::string& argument) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size())
    throw InputError("omma feed", 0, "--camera", "CAMERA=DEVICE, for instance cam0=/dev/video10", argument);
  FedCamera camera;
  camera.name = argument.substr(0, equals);
  camera.device = argument.substr(equals + 1);
  // All of it is decoded before the first frame is due.
  const std::filesystem::path folder = std::filesystem::path(options.recording) / camera.name;
  for (const RecordedCamera::File& file : RecordedCamera::find_files(folder, camera.name)) {
    if (options.frames > 0 && camera.images.size() == options.frames) break;
    camera.numbers.push_back(file.number);
    camera.images.push_back(read_image(file.path));
    const Image& first = camera.images.front();
    const Image& last = camera.images.back();
    if (last.width != first.width || last.height != first.height || last.format != first.format)
      throw InputError(file.path.string(), 0, "image", "the size and depth of the first", "another");
  }
  return camera;
}

int feed(const FeedOptions& options) {
  std::vector<FedCamera> cameras;
  for (const std::string& argument : options.cameras) cameras.push_back(read_camera(options, argument));
  std::size_t count = cameras.front().images.size();
  for (FedCamera& camera : cameras) {
    camera.open();
    count = std::min(count, camera.images.size());
  }
  std::ofstream log;
  if (!options.log.empty()) {
    log.open(options.log);
    log << "frame,time_ns\n";
    if (!log) throw InputError(options.log, 0, "--log", "a file that can be written", "none");
  }
  catch_interrupts();
  MonotonicClock clock;
  const auto period = static_cast<TimeNs>(1e9 / options.rate_hz);
  const TimeNs start = clock.now() + period;
  std::size_t fed = 0;
  const std::size_t total = count * static_cast<std::size_t>(options.rounds);
  for (; fed < total && !interrupted(); ++fed) {
    clock.sleep_until(start + static_cast<TimeNs>(fed) * period);
    const TimeNs now = clock.now();
    for (const FedCamera& camera : cameras) camera.give(fed % count, now);
    if (log.is_open()) log << cameras.front().numbers[fed % count] << ',' << now << '\n' << std::flush;
  }
  const double seconds = static_cast<double>(clock.now() - start) * 1e-9;
  std::printf("%zu frame sets of %zu cameras fed in %.2f s\n", fed, cameras.size(), seconds);
  for (const FedCamera& camera : cameras) camera.print_settings();
  return 0;
}

}  // namespace

void add_feed(CLI::App& app, CommandContext& context) {
  auto o = std::make_shared<FeedOptions>();
  CLI::App* command = app.add_subcommand(
      "feed", "Play a recording into video devices (v4l2loopback) or shared memory, as cameras");
  command->add_option("recording", o->recording, "Folder of frames, <camera>/<camera>_<number>.png")
      ->required();
  command
      ->add_option("--camera", o->cameras,
                   "CAMERA=DEVICE, or CAMERA=simulated:NAME for the driver of that name; may be repeated")
      ->required();
  command->add_option("--rate", o->rate_hz, "Frame sets a second")->check(CLI::Range(0.01, 1000.0));
  command->add_option("--frames", o->frames, "Stop after so many frame sets");
  command->add_option("--rounds", o->rounds, "Play the recording so many times, one after the other")
      ->check(CLI::Range(1, 100000));
  command->add_option("--log", o->log, "File (CSV) for the instant each frame set was given");
  command->callback([o, &context] { context.exit_code = feed(*o); });
}

}  // namespace omma::ground
