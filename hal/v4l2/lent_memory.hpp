// DMA-bufs that a camera fills though they are another owner's: of a DMA heap (/dev/dma_heap/...), as ARM
// boards have for memory that a display, a codec and a camera share, or of another video device's queue.
// Source: Linux kernel, Documentation/userspace-api/dma-buf-alloc-exchange.rst, media/v4l/dmabuf.rst.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/v4l2/v4l2_device.hpp"

namespace omma {

class LentMemory {
 public:
  LentMemory() = default;
  ~LentMemory() { close(); }
  LentMemory(const LentMemory&) = delete;
  LentMemory& operator=(const LentMemory&) = delete;

  /// @param path  of a DMA heap, or of a video device whose queue nobody uses
  /// @return 0, or the errno; ENOTTY where it is neither
  int open(const std::string& path);
  /// Makes room for `count` buffers of at least `bytes` each; a video device then is in use, its format kept.
  /// @return 0, or the errno
  int reserve(std::size_t count, std::size_t bytes);
  /// @param file  then is the buffer's, for the caller to close; it stays valid when the owner is gone
  /// @param size  of it [bytes]
  /// @return 0, or the errno
  int lend(std::size_t index, int& file, std::size_t& size) const;
  void close() noexcept;

 private:
  int reserve_in_queue(std::uint32_t count, std::size_t bytes);

  v4l2::Device owner_;
  std::uint32_t queue_ = 0;  // V4L2_BUF_TYPE_...; 0: a heap
  std::size_t bytes_ = 0;    // of a buffer
};

/// The DMA heaps of this machine, by their paths.
std::vector<std::string> dma_heaps();

}  // namespace omma
