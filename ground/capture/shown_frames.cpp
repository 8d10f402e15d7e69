#include "ground/capture/shown_frames.hpp"

#include <algorithm>
#include <utility>

namespace omma::ground {

void ShownFrames::offer(const LiveFrame& frame) {
  if (!asked_.exchange(false, std::memory_order_relaxed)) return;
  auto shown = std::make_shared<ShownFrame>();
  Image& image = shown->image;
  image.resize(frame.image.width, frame.image.height, frame.image.format);
  image.white_level = frame.image.white_level;
  const std::ptrdiff_t row = image.view().stride;
  for (int v = 0; v < image.height; ++v)
    std::copy_n(frame.image.data + v * frame.image.stride, row, image.pixels.data() + v * row);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    shown->count = newest_ ? newest_->count + 1 : 1;
    newest_ = std::move(shown);
  }
  arrived_.notify_all();
}

std::shared_ptr<const ShownFrame> ShownFrames::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

std::shared_ptr<const ShownFrame> ShownFrames::newer(std::uint64_t count, std::chrono::milliseconds most) {
  ask();
  std::unique_lock<std::mutex> lock(mutex_);
  const bool came = arrived_.wait_for(lock, most, [&] { return newest_ && newest_->count > count; });
  return came ? newest_ : nullptr;
}

}  // namespace omma::ground
