#include "hal/recorded/recorded_camera.hpp"

#include <algorithm>
#include <exception>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

std::string size_text(const ImageSize& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " px of " +
         std::to_string(size.bits) + " bits";
}

}  // namespace

void RecordedCamera::check_headers(const RecordedCameraOptions& options) const {
  ImageSize expected = store_->size(0);
  if (options.width > 0) expected.width = options.width;
  if (options.height > 0) expected.height = options.height;
  if (options.bits > 0) expected.bits = options.bits;
  for (std::size_t i = 0; i < store_->count(); ++i) {
    const ImageSize size = store_->size(i);
    if (size.width != expected.width || size.height != expected.height || size.bits != expected.bits) {
      throw InputError(store_->name(i), 0, "image size", size_text(expected), size_text(size));
    }
  }
}

// Later rounds are the same frames under later numbers.
void RecordedCamera::list_frames(const RecordedCameraOptions& options) {
  const std::size_t once = store_->count();
  const std::uint64_t length = std::max(options.round_length, store_->number(once - 1) + 1);
  const int rounds = std::max(1, options.rounds);
  frames_.reserve(once * static_cast<std::size_t>(rounds));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < once; ++i)
      frames_.push_back({store_->number(i) + static_cast<std::uint64_t>(round) * length, i});
  }
}

RecordedCamera::RecordedCamera(std::unique_ptr<FrameStore> store, const RecordedCameraOptions& options)
    : store_(std::move(store)), playback_(options.playback), white_level_(options.white_level) {
  check_headers(options);
  list_frames(options);
  // The first frame is decoded here: a recording that cannot be read at all must fail now. Its size is
  // everyone's.
  Image first;
  store_->read(0, first);
  for (Slot& slot : slots_) slot.image.resize(first.width, first.height, first.format);
  reader_ = std::thread([this] { read_ahead(); });
  if (playback_ == Playback::kRealTime) {
    const auto ready = static_cast<std::uint32_t>(std::min<std::size_t>(kSlots, frames_.size()));
    for (std::uint32_t filled = 0; filled < ready; filled = filled_.load(std::memory_order_acquire)) {
      filled_.wait(filled, std::memory_order_acquire);
    }
  }
}

RecordedCamera::~RecordedCamera() {
  stop_.store(true, std::memory_order_release);
  released_.fetch_add(1, std::memory_order_release);  // changes what the reading thread may be waiting on
  released_.notify_one();
  reader_.join();
}

bool RecordedCamera::wait_for_free_slot(std::uint32_t filled) {
  for (;;) {
    const std::uint32_t released = released_.load(std::memory_order_acquire);
    if (stop_.load(std::memory_order_acquire)) return false;
    if (filled - released < kSlots) return true;
    released_.wait(released, std::memory_order_acquire);
  }
}

void RecordedCamera::fill(Slot& slot, const Recorded& frame) {
  const Image& image = slot.image;
  const ImageSize size{image.width, image.height, image.bytes_per_pixel()};
  slot.number = frame.number;
  slot.settings = store_->settings(frame.index);
  try {
    store_->read(frame.index, slot.image);
    slot.readable = true;
  } catch (const std::exception&) {  // a frame lost, not a mission
    slot.readable = false;
  }
  // The file may have been replaced since its header was looked at.
  if (image.width != size.width || image.height != size.height || image.bytes_per_pixel() != size.bits) {
    slot.image.resize(size.width, size.height, size.bits == 1 ? PixelFormat::kGrey8 : PixelFormat::kGrey16);
    slot.readable = false;
  }
  if (white_level_ > 0) slot.image.white_level = white_level_;
  if (!slot.readable) unreadable_.fetch_add(1, std::memory_order_relaxed);
}

void RecordedCamera::read_ahead() {
  std::uint32_t filled = 0;
  for (const Recorded& frame : frames_) {
    // What is older than the newest number asked for would be thrown away unseen.
    if (frame.number + 1 < asked_.load(std::memory_order_acquire)) continue;
    if (!wait_for_free_slot(filled)) return;
    if (frame.number + 1 < asked_.load(std::memory_order_acquire)) continue;
    fill(slots_[filled % kSlots], frame);
    filled_.store(++filled, std::memory_order_release);
    filled_.notify_one();
  }
}

Frame RecordedCamera::grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept {
  Frame frame;
  frame.number = number;
  frame.exposure_midpoint_ns = trigger_time_ns;
  if (number + 1 < asked_.load(std::memory_order_relaxed)) return frame;
  asked_.store(number + 1, std::memory_order_release);
  // The oldest slot is the frame of the last grab until here. Each turn frees a slot or waits for the next
  // frame; at most kSlots + 1 older frames can come before the reading thread skips them.
  std::uint32_t released = released_.load(std::memory_order_relaxed);
  for (;;) {
    const std::uint32_t filled = filled_.load(std::memory_order_acquire);
    if (released == filled) {
      if (playback_ == Playback::kRealTime || number > last_number()) return frame;
      filled_.wait(filled, std::memory_order_acquire);
      continue;
    }
    const Slot& slot = slots_[released % kSlots];
    if (slot.number >= number) {
      if (slot.number == number && slot.readable) {
        frame.image = slot.image.view();
        frame.settings = slot.settings;
        frame.status = FrameStatus::kFresh;
      }
      return frame;
    }
    released_.store(++released, std::memory_order_release);
    released_.notify_one();
  }
}

}  // namespace omma
