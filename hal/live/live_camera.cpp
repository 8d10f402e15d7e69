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
      take_one();
    } else {
      reopen();
    }
  }
}

void LiveCamera::take_one() {
  const std::uint32_t filled = filled_.load(std::memory_order_relaxed);
  const bool room = filled - released_.load(std::memory_order_acquire) < slots_.size();
  Slot& into = room ? slot(filled) : spare_;
  const Taken taken = source_->take(into.pixels.data(), std::min(kPollMs, timeout_ms_));
  switch (taken.status) {
    case TakeStatus::kFrame:
      silent_ms_ = 0;
      count_gap(taken.sequence);
      count(delivered_);
      into.time_ns = taken.time_ns;
      into.sequence = taken.sequence;
      if (room) {
        filled_.store(filled + 1, std::memory_order_release);
      } else {
        count(overrun_);
      }
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

void LiveCamera::count_gap(std::uint32_t sequence) {
  if (last_sequence_ && sequence > *last_sequence_ + 1) count(gaps_, sequence - *last_sequence_ - 1);
  last_sequence_ = sequence;
}

void LiveCamera::lose() {
  source_->stop();
  open_ = false;
  silent_ms_ = 0;
  last_sequence_.reset();
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
  if (!release_and_peek()) return std::nullopt;
  in_use_ = true;
  const Slot& oldest = slot(released_.load(std::memory_order_relaxed));
  return LiveFrame{view(oldest), oldest.time_ns, oldest.sequence};
}

Frame LiveCamera::grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept {
  Frame frame;
  frame.number = number;
  frame.exposure_midpoint_ns = trigger_time_ns;
  bool late = false;
  for (std::size_t i = 0; i <= slots_.size() && release_and_peek(); ++i) {
    const Slot& oldest = slot(released_.load(std::memory_order_relaxed));
    const TimeNs age = elapsed(oldest.time_ns, trigger_time_ns);
    if (!phase_->known() && age >= 0) phase_->learn(age);
    if (age < phase_->youngest()) break;  // it belongs to a later trigger
    in_use_ = true;
    if (age < phase_->oldest()) {
      frame.image = view(oldest);
      frame.exposure_midpoint_ns = oldest.time_ns;
      frame.status = FrameStatus::kFresh;
      return frame;
    }
    count(unmatched_);
    late = true;
  }
  if (late) frame.status = FrameStatus::kLate;
  return frame;
}

}  // namespace omma
