// The newest frame of a camera for whoever looks on: copied only where somebody has asked for it, so that
// capturing is not slowed by nobody's looking.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "hal/live/live_camera.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {

struct ShownFrame {
  Image image;
  std::uint64_t count = 0;  ///< frames shown so far, this one included
};

class ShownFrames {
 public:
  /// The next frame is wanted.
  void ask() { asked_.store(true, std::memory_order_relaxed); }

  /// From the thread that takes the frames, with each of them.
  void offer(const LiveFrame& frame);

  /// Null where none was shown yet.
  std::shared_ptr<const ShownFrame> newest() const;
  /// The newest one after the frame `count`, which is waited for; null where none comes in time.
  std::shared_ptr<const ShownFrame> newer(std::uint64_t count, std::chrono::milliseconds most);

 private:
  std::atomic<bool> asked_{false};
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::shared_ptr<const ShownFrame> newest_;
};

}  // namespace omma::ground
