#include "ground/capture/recorder.hpp"

#include <algorithm>
#include <cmath>

#include "hal/sources/live_drivers.hpp"

namespace omma::ground {
namespace {

constexpr std::size_t kRoomBytes = 64U << 20U;  // of each camera, for what the disk does not take at once
constexpr TimeNs kRateWindow = 1'000'000'000;
constexpr std::chrono::seconds kQuiet{3};  // without a frame: its rate is none

}  // namespace

Recorder::Recorder(const CaptureCamera& camera, const RecorderOptions& options, CaptureStart& start)
    : name_(camera.name),
      driver_(camera.driver),
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

void Recorder::start() {
  writer_ = std::thread([this] { write(); });
}

void Recorder::stop() {
  stop_.store(true);
  if (writer_.joinable()) writer_.join();
}

void Recorder::write() {
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

void Recorder::keep(const LiveFrame& frame) {
  const std::uint64_t number = numbers_.number(frame.time_ns, frame.sequence);
  if (folder_) {
    folder_->write(number, frame);
    bytes_.store(folder_->bytes());
  }
  last_ = Clock::now();
  last_stamp_ns_ = frame.time_ns;
  if (taken_.load() == 0) {
    first_ = last_;
    first_stamp_ns_ = frame.time_ns;
  }
  note_rate(frame.time_ns);
  exposure_ns_.store(frame.settings.exposure_ns);
  gain_.store(frame.settings.gain);
  taken_.fetch_add(1);
  shown_.offer(frame);
}

void Recorder::note_rate(TimeNs stamp_ns) {
  newest_at_.store(last_.time_since_epoch().count());
  const TimeNs since = elapsed(rate_since_ns_, stamp_ns);
  if (rate_since_ns_ != 0 && since < kRateWindow) {
    ++rate_frames_;
    return;
  }
  if (rate_since_ns_ != 0 && since < 4 * kRateWindow)
    newest_rate_hz_.store(static_cast<double>(rate_frames_ + 1) * 1e9 / static_cast<double>(since));
  rate_since_ns_ = stamp_ns;
  rate_frames_ = 0;
}

double Recorder::newest_rate_hz() const {
  const Clock::time_point newest{Clock::duration{newest_at_.load()}};
  return Clock::now() - newest < kQuiet ? newest_rate_hz_.load() : 0;
}

double Recorder::rate_hz() const {
  const double stamped = static_cast<double>(elapsed(first_stamp_ns_, last_stamp_ns_)) * 1e-9;
  return stamped > 0 ? static_cast<double>(taken() - 1) / stamped : 0;
}

bool Recorder::complete() const {
  const CameraHealth lost = health();
  return failure_.empty() && taken() > 0 && lost.gaps + lost.damaged + lost.overrun + lost.losses == 0;
}

}  // namespace omma::ground
