#include "hal/live/live_camera.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "fsw/kernel/real_time.hpp"

namespace omma {
namespace {

constexpr int kPollMs = 100;  // the thread looks at least so often whether it is to stop
constexpr std::chrono::milliseconds kBetweenAttempts{200};  // to open a lost device again

// Only one thread writes each counter; no read-modify-write is needed.
void count(std::atomic<std::uint32_t>& counter, std::uint32_t by = 1) {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

}  // namespace

LiveCamera::LiveCamera(std::unique_ptr<FrameSource> source, std::shared_ptr<FramePhase> phase, int timeout_ms,
                       std::uint32_t slots, int priority)
    : source_(std::move(source)),
      phase_(std::move(phase)),
      shape_(source_->shape()),
      timeout_ms_(timeout_ms),
      priority_(priority),
      slots_(std::clamp<std::uint32_t>(slots, 2, 256)) {
  for (Slot& slot : slots_) slot.pixels.resize(shape_.bytes());
  spare_.pixels.resize(shape_.bytes());
  source_->start();
  range_ = source_->settings_range();
  watcher_ = std::thread([this] { watch(); });
}

LiveCamera::~LiveCamera() {
  {
    const std::lock_guard<std::mutex> lock(pause_mutex_);
    stop_ = true;
  }
  pause_.notify_one();
  watcher_.join();
  source_->stop();
}

void LiveCamera::watch() {
  // Where it is not granted, the steps' own threads say so.
  if (priority_ > 0) make_thread_real_time("live camera", priority_);
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(pause_mutex_);
      if (!open_) pause_.wait_for(lock, kBetweenAttempts, [this] { return stop_; });
      if (stop_) return;
    }
    if (open_) {
      set_what_was_asked();
      take_one();
    } else {
      reopen();
    }
  }
}

void LiveCamera::set_what_was_asked() {
  if (asked_.acquire()) {
    settings_ = asked_.front();
  } else if (!settings_ || source_->settings() == *settings_ || refused_.load(std::memory_order_relaxed)) {
    return;  // nothing new, and the device has not forgotten it
  }
  refused_.store(!source_->apply(*settings_), std::memory_order_relaxed);
}

SettingsResult LiveCamera::apply(const CameraSettings& settings) noexcept {
  if (range_.least == range_.most) return SettingsResult::kNoControl;
  const auto lies_in = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  if (!lies_in(settings.exposure_ns, range_.least.exposure_ns, range_.most.exposure_ns) ||
      !lies_in(settings.gain, range_.least.gain, range_.most.gain) ||
      !lies_in(settings.black_level, range_.least.black_level, range_.most.black_level))
    return SettingsResult::kOutOfRange;
  if (!connected_.load(std::memory_order_relaxed) || refused_.load(std::memory_order_relaxed))
    return SettingsResult::kFailed;
  asked_.back() = settings;
  asked_.publish();
  return SettingsResult::kAccepted;
}

void LiveCamera::take_one() {
  const Taken taken = source_->take(spare_.pixels.data(), std::min(kPollMs, timeout_ms_));
  switch (taken.status) {
    case TakeStatus::kFrame:
      silent_ms_ = 0;
      count_gap(taken.sequence);
      count(delivered_);
      keep_spare(taken);
      break;
    case TakeStatus::kDamaged:
      silent_ms_ = 0;
      count_gap(taken.sequence);
      count(damaged_);
      break;
    case TakeStatus::kSilence:
      silent_ms_ += std::min(kPollMs, timeout_ms_);
      if (silent_ms_ >= timeout_ms_) lose();
      break;
    case TakeStatus::kGone:
      lose();
      break;
  }
}

void LiveCamera::keep_spare(const Taken& taken) {
  const std::uint32_t filled = filled_.load(std::memory_order_relaxed);
  if (filled - released_.load(std::memory_order_acquire) >= slots_.size()) {
    if (wanted_.load(std::memory_order_relaxed)) count(overrun_);
    return;
  }
  spare_.time_ns = taken.time_ns;
  spare_.sequence = taken.sequence;
  spare_.settings = source_->settings();
  std::swap(spare_, slot(filled));
  filled_.store(filled + 1, std::memory_order_release);
}

void LiveCamera::count_gap(std::uint32_t sequence) {
  if (wanted_.load(std::memory_order_relaxed) && last_sequence_ && sequence > *last_sequence_ + 1)
    count(gaps_, sequence - *last_sequence_ - 1);
  last_sequence_ = sequence;
}

void LiveCamera::lose() {
  source_->stop();
  open_ = false;
  silent_ms_ = 0;
  last_sequence_.reset();
  refused_.store(false, std::memory_order_relaxed);
  connected_.store(false, std::memory_order_relaxed);
  count(losses_);
  phase_->forget();
}

void LiveCamera::reopen() {
  try {
    source_->start();
    open_ = true;
    connected_.store(true, std::memory_order_relaxed);
  } catch (const std::exception&) {  // not there yet
  }
}

CameraHealth LiveCamera::health() const noexcept {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  return {.connected = connected_.load(kRelaxed),
          .delivered = delivered_.load(kRelaxed),
          .gaps = gaps_.load(kRelaxed),
          .damaged = damaged_.load(kRelaxed),
          .unmatched = unmatched_.load(kRelaxed),
          .overrun = overrun_.load(kRelaxed),
          .losses = losses_.load(kRelaxed)};
}

ImageView LiveCamera::view(const Slot& slot) const {
  return {slot.pixels.data(), shape_.width,
          shape_.height,      static_cast<std::ptrdiff_t>(shape_.row_bytes()),
          shape_.format,      shape_.white_level};
}

// Gives back the frame in use; true where another one waits.
bool LiveCamera::release_and_peek() noexcept {
  std::uint32_t released = released_.load(std::memory_order_relaxed);
  if (in_use_) released_.store(++released, std::memory_order_release);
  in_use_ = false;
  return released != filled_.load(std::memory_order_acquire);
}

std::optional<LiveFrame> LiveCamera::next() noexcept {
  wanted_.store(true, std::memory_order_relaxed);
  if (!release_and_peek()) return std::nullopt;
  in_use_ = true;
  const Slot& oldest = slot(released_.load(std::memory_order_relaxed));
  return LiveFrame{view(oldest), oldest.time_ns, oldest.sequence, oldest.settings};
}

Frame LiveCamera::grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept {
  Frame frame;
  frame.number = number;
  frame.exposure_midpoint_ns = trigger_time_ns;
  bool late = false;
  const bool first = !wanted_.exchange(true, std::memory_order_relaxed);
  for (std::size_t i = 0; i <= slots_.size() && release_and_peek(); ++i) {
    const Slot& oldest = slot(released_.load(std::memory_order_relaxed));
    const TimeNs age = elapsed(oldest.time_ns, trigger_time_ns);
    if (!phase_->known() && age >= 0) phase_->learn(age);
    if (age < phase_->youngest()) break;  // it belongs to a later trigger
    in_use_ = true;
    if (age < phase_->oldest()) {
      frame.image = view(oldest);
      frame.exposure_midpoint_ns = oldest.time_ns;
      frame.settings = oldest.settings;
      frame.status = FrameStatus::kFresh;
      return frame;
    }
    if (first) continue;  // it came before anyone asked
    count(unmatched_);
    late = true;
  }
  if (late) frame.status = FrameStatus::kLate;
  return frame;
}

}  // namespace omma
