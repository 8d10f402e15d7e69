#include "ground/capture/capture.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <list>
#include <memory>
#include <thread>

#include "fsw/kernel/input_error.hpp"
#include "ground/capture/capture_options.hpp"
#include "ground/capture/frame_folder.hpp"
#include "ground/capture/half_blocks.hpp"
#include "ground/interrupt.hpp"
#include "hal/sources/live_drivers.hpp"

namespace omma::ground {
namespace {

using Clock = std::chrono::steady_clock;

struct CaptureOptions {
  CaptureArguments cameras;
  std::string output;
  std::uint64_t frames = 0;
  double seconds = 0;
  bool compress = false;
  bool view = false;
};

constexpr std::size_t kRoomBytes = 64U << 20U;  // of each camera, for what the disk does not take at once

/// One camera being captured: its frames are written by a thread of their own.
class Recorder {
 public:
  Recorder(const CaptureCamera& camera, const CaptureOptions& options, CaptureStart& start)
      : name_(camera.name),
        frames_wanted_(options.frames),
        numbers_(start, camera.setup.frame_rate_hz > 0 ? std::llround(1e9 / camera.setup.frame_rate_hz) : 0) {
    if (!options.output.empty())
      folder_ = std::make_unique<FrameFolder>(options.output, camera.name,
                                              options.compress ? PngEffort::kFast : PngEffort::kStored);
    auto source = make_frame_source(camera.driver, camera.setup);
    const auto slots =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(kRoomBytes / source->shape().bytes(), 8, 256));
    camera_ = std::make_unique<LiveCamera>(std::move(source), std::make_shared<FramePhase>(1),
                                           camera.setup.timeout_ms, slots);
  }
  ~Recorder() { stop(); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void start() {
    writer_ = std::thread([this] { write(); });
  }
  /// What the device gave until now is still written.
  void stop() {
    stop_.store(true);
    if (writer_.joinable()) writer_.join();
  }
  bool done() const { return done_.load(); }
  const std::string& name() const { return name_; }
  CameraHealth health() const { return camera_->health(); }
  std::uint64_t taken() const { return taken_.load(); }
  std::uint64_t bytes() const { return folder_ ? folder_->bytes() : 0; }
  const std::string& failure() const { return failure_; }
  const GreyShape& shape() const { return camera_->shape(); }
  /// Frames taken a second, by the device's stamps.
  double rate_hz() const {
    const double stamped = static_cast<double>(elapsed(first_stamp_ns_, last_stamp_ns_)) * 1e-9;
    return stamped > 0 ? static_cast<double>(taken() - 1) / stamped : 0;
  }
  double seconds() const { return std::chrono::duration<double>(last_ - first_).count(); }
  /// The newest image, where one is asked for.
  void view(bool on) { view_.store(on); }
  std::string picture() {
    const std::lock_guard<std::mutex> lock(picture_mutex_);
    return picture_;
  }

 private:
  void write() {
    try {
      for (;;) {
        const bool last_round = stop_.load();
        while (frames_wanted_ == 0 || taken_.load() < frames_wanted_) {
          const auto frame = camera_->next();
          if (!frame) break;
          keep(*frame);
        }
        if (last_round || (frames_wanted_ > 0 && taken_.load() >= frames_wanted_)) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    } catch (const std::exception& error) {
      failure_ = error.what();
    }
    done_.store(true);
  }

  void keep(const LiveFrame& frame) {
    const std::uint64_t number = numbers_.number(frame.time_ns, frame.sequence);
    if (folder_) folder_->write(number, frame);
    last_ = Clock::now();
    last_stamp_ns_ = frame.time_ns;
    if (taken_.load() == 0) {
      first_ = last_;
      first_stamp_ns_ = frame.time_ns;
    }
    taken_.fetch_add(1);
    if (view_.exchange(false)) {
      std::string text = half_blocks(frame.image, columns_, rows_);
      const std::lock_guard<std::mutex> lock(picture_mutex_);
      picture_ = std::move(text);
    }
  }

  std::string name_;
  std::uint64_t frames_wanted_;
  FrameNumbers numbers_;
  std::unique_ptr<FrameFolder> folder_;
  std::unique_ptr<LiveCamera> camera_;
  Clock::time_point first_{}, last_{};
  TimeNs first_stamp_ns_ = 0, last_stamp_ns_ = 0;
  std::atomic<std::uint64_t> taken_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> done_{false};
  std::atomic<bool> view_{false};
  std::string failure_;  // read after done
  std::mutex picture_mutex_;
  std::string picture_;
  int columns_ = 100;
  int rows_ = 30;
  std::thread writer_;
};

using Recorders = std::list<Recorder>;

void show(Recorders& recorders) {
  std::printf("\033[H\033[2J");
  for (Recorder& recorder : recorders) {
    std::printf("%s  %llu frames\n%s", recorder.name().c_str(),
                static_cast<unsigned long long>(recorder.taken()), recorder.picture().c_str());
    recorder.view(true);
  }
  std::fflush(stdout);
}

// Says when a camera is lost and when it is back.
void tell_changes(const Recorders& recorders, std::vector<CameraHealth>& told) {
  std::size_t i = 0;
  for (const Recorder& recorder : recorders) {
    const CameraHealth now = recorder.health();
    CameraHealth& before = told[i++];
    if (now.losses != before.losses)
      std::fprintf(stderr, "%s: gone or silent, looked for\n", recorder.name().c_str());
    if (now.connected && !before.connected)
      std::fprintf(stderr, "%s: delivers again\n", recorder.name().c_str());
    before = now;
  }
}

void wait_for_end(Recorders& recorders, const CaptureOptions& options) {
  const Clock::time_point begin = Clock::now();
  std::vector<CameraHealth> told(recorders.size());
  for (;;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    tell_changes(recorders, told);
    if (options.view) show(recorders);
    const bool all_done =
        std::all_of(recorders.begin(), recorders.end(), [](const Recorder& r) { return r.done(); });
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (all_done || interrupted() || (options.seconds > 0 && seconds >= options.seconds)) return;
  }
}

/// @return true where every frame the devices counted is there
bool print_result(const Recorders& recorders) {
  bool complete = true;
  double total_bytes = 0;
  double longest = 0;
  for (const Recorder& recorder : recorders) {
    const CameraHealth health = recorder.health();
    std::printf(
        "%s: %llu frames of %d x %d px at %.2f Hz; lost: %u gaps, %u damaged, %u without room; "
        "%u times gone\n",
        recorder.name().c_str(), static_cast<unsigned long long>(recorder.taken()), recorder.shape().width,
        recorder.shape().height, recorder.rate_hz(), health.gaps, health.damaged, health.overrun,
        health.losses);
    if (!recorder.failure().empty()) std::fprintf(stderr, "omma: %s\n", recorder.failure().c_str());
    complete = complete && recorder.failure().empty() && recorder.taken() > 0 &&
               health.gaps + health.damaged + health.overrun + health.losses == 0;
    total_bytes += static_cast<double>(recorder.bytes());
    longest = std::max(longest, recorder.seconds());
  }
  if (total_bytes > 0 && longest > 0)
    std::printf("%.1f MB written, %.1f MB/s sustained\n", total_bytes / 1e6, total_bytes / 1e6 / longest);
  return complete;
}

int capture(const CaptureOptions& options) {
  const std::vector<CaptureCamera> cameras = capture_cameras(options.cameras);
  catch_interrupts();
  CaptureStart start;
  Recorders recorders;
  for (const CaptureCamera& camera : cameras) recorders.emplace_back(camera, options, start);
  for (Recorder& recorder : recorders) recorder.start();
  wait_for_end(recorders, options);
  for (Recorder& recorder : recorders) recorder.stop();
  if (!options.output.empty()) {
    const Clock::time_point begin = Clock::now();
    ::sync();
    std::printf("all on the disk %.2f s after the last frame\n",
                std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return print_result(recorders) ? 0 : 1;
}

}  // namespace

void add_capture(CLI::App& app, CommandContext& context) {
  auto o = std::make_shared<CaptureOptions>();
  CaptureArguments& a = o->cameras;
  CLI::App* command = app.add_subcommand("capture", "Write frames of live cameras to disk, or look at them");
  command->add_option("mission", a.mission, "Mission file whose live cameras are captured");
  command->add_option("--camera", a.cameras, "NAME=DRIVER:DEVICE, instead of a mission; may be repeated");
  command->add_option("--size", a.size, "Of the images, WIDTHxHEIGHT");
  command->add_option("--format", a.format, "Of the pixels, as `omma cameras` lists it");
  command->add_option("--bayer", a.bayer, "A colour mosaic becomes: grey, green or raw")
      ->check(CLI::IsMember({"grey", "green", "raw"}));
  command->add_option("--memory", a.memory, "mmap or dma-buf")->check(CLI::IsMember({"mmap", "dma-buf"}));
  command->add_option("--rate", a.rate_hz, "Asked of the device [Hz]")->check(CLI::Range(0.0, 1000.0));
  command->add_option("--timeout-ms", a.timeout_ms, "Silence after which the stream is started anew")
      ->check(CLI::Range(10, 60000));
  command->add_option("--set", a.controls,
                      "NAME=VALUE: a control, for instance exposure=100; may be repeated");
  command->add_option("--output", o->output, "Folder; without it frames are only counted");
  command->add_option("--frames", o->frames, "Stop after so many of each camera");
  command->add_option("--seconds", o->seconds, "Stop after so long");
  command->add_flag("--compress", o->compress, "Smaller files, more work");
  command->add_flag("--view", o->view, "Show the cameras in the terminal");
  command->callback([o, &context] { context.exit_code = capture(*o); });
}

}  // namespace omma::ground
