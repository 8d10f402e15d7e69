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
#include "ground/feed/sync_line.hpp"
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
  std::string fired_by;
  std::size_t lose_every = 0;
  std::size_t late_every = 0;
  std::size_t hold_every = 0;
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
  for (const FrameFile& file : find_frame_files(folder, camera.name)) {
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

// When each frame set is due: on a grid, or at the frame-sync line's edges.
class Instants {
 public:
  explicit Instants(const FeedOptions& options)
      : period_(static_cast<TimeNs>(1e9 / options.rate_hz)), start_(clock_.now() + period_) {
    if (!options.fired_by.empty()) line_ = std::make_unique<SyncLine>(options.fired_by);
  }
  /// False where this program was interrupted.
  bool wait(std::size_t turn) {
    if (line_) return line_->wait_for_edge() != 0;
    clock_.sleep_until(start_ + static_cast<TimeNs>(turn) * period_);
    return !interrupted();
  }
  /// Two fifths of a period: too late for its trigger, too early for the next.
  void be_late() { clock_.sleep_until(clock_.now() + 2 * period_ / 5); }
  TimeNs now() { return clock_.now(); }
  double seconds() { return static_cast<double>(clock_.now() - start_) * 1e-9; }

 private:
  MonotonicClock clock_;
  TimeNs period_;
  TimeNs start_;
  std::unique_ptr<SyncLine> line_;
};

class FeedLog {
 public:
  explicit FeedLog(const std::string& path) {
    if (path.empty()) return;
    file_.open(path);
    file_ << "frame,time_ns\n" << std::flush;
    if (!file_) throw InputError(path, 0, "--log", "a file that can be written", "none");
  }
  void add(std::uint64_t frame, TimeNs time_ns) {
    if (file_.is_open()) file_ << frame << ',' << time_ns << '\n' << std::flush;
  }

 private:
  std::ofstream file_;
};

/// A frame set kept back with the stamp it has.
struct Held {
  std::size_t turn = 0;
  std::size_t frame = 0;
  TimeNs time_ns = 0;
};

void check_hold(const FeedOptions& options, const std::vector<FedCamera>& cameras) {
  if (options.hold_every == 0) return;
  for (const FedCamera& camera : cameras)
    if (camera.device.rfind(kShared, 0) != 0)
      throw InputError(
          "omma feed", 0, "--hold-every",
          "cameras of the driver simulated (a video device stamps its frames when it is given them)",
          camera.device);
}

int feed(const FeedOptions& options) {
  std::vector<FedCamera> cameras;
  for (const std::string& argument : options.cameras) cameras.push_back(read_camera(options, argument));
  check_hold(options, cameras);
  std::size_t count = cameras.front().images.size();
  for (FedCamera& camera : cameras) {
    camera.open();
    count = std::min(count, camera.images.size());
  }
  // A loopback device can be opened by its reader from its first frame on, and who fires the cameras reads
  // them.
  if (!options.fired_by.empty())
    for (const FedCamera& camera : cameras) camera.give(0, MonotonicClock().now());
  catch_interrupts();
  Instants instants(options);
  FeedLog log(options.log);
  const auto is_every = [](std::size_t turn, std::size_t every) {
    return every > 0 && turn % every == every - 1;
  };
  const std::size_t total = count * static_cast<std::size_t>(options.rounds);
  std::size_t fed = 0, lost = 0, late = 0;
  std::vector<Held> held;
  for (std::size_t turn = 0; turn < total && instants.wait(turn); ++turn) {
    if (is_every(turn, options.lose_every)) {
      ++lost;
      continue;
    }
    if (is_every(turn, options.late_every)) {
      ++late;
      instants.be_late();
    }
    const TimeNs now = instants.now();
    if (is_every(turn, options.hold_every)) {
      held.push_back({turn, turn % count, now});
      continue;
    }
    // Two turns: after one a flight that is behind may still be waiting for them.
    if (!held.empty() && turn >= held.front().turn + 2) {
      for (const FedCamera& camera : cameras) camera.give(held.front().frame, held.front().time_ns);
      held.erase(held.begin());
    }
    for (const FedCamera& camera : cameras) camera.give(turn % count, now);
    log.add(cameras.front().numbers[turn % count], now);
    ++fed;
  }
  std::printf("%zu frame sets of %zu cameras fed in %.2f s", fed, cameras.size(), instants.seconds());
  if (options.lose_every + options.late_every > 0)
    std::printf(", %zu of them late; %zu left out", late, lost);
  std::printf("\n");
  for (const FedCamera& camera : cameras) camera.print_settings();
  return 0;
}

}  // namespace

void add_feed(CLI::App& app, CommandContext& context) {
  auto o = std::make_shared<FeedOptions>();
  const CLI::Range every(1, 1'000'000);
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
  command->add_option(
      "--fired-by", o->fired_by,
      "File that reads 1 while the frame-sync line is active (gpio-sim's value): each edge is a frame "
      "set, instead of the rate");
  command
      ->add_option("--lose-every", o->lose_every,
                   "Leave out the last of so many, as a camera that misses a pulse")
      ->check(every);
  command->add_option("--late-every", o->late_every, "Give the last of so many two fifths of a period late")
      ->check(every);
  command
      ->add_option("--hold-every", o->hold_every,
                   "Give the last of so many two frame sets later, with the stamp it had")
      ->check(every);
  command->add_option("--log", o->log, "File (CSV) for the instant each frame set was given");
  command->callback([o, &context] { context.exit_code = feed(*o); });
}

}  // namespace omma::ground
