#include "hal/v4l2/lent_memory.hpp"

#include <fcntl.h>
#include <linux/dma-heap.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>

namespace omma {
namespace {

/// The queue whose buffers a video device lends, 0 where it is no video device or has none in one plane.
std::uint32_t queue_of(const v4l2::Device& device) {
  v4l2_capability capability{};
  if (device.control(VIDIOC_QUERYCAP, &capability) != 0) return 0;
  const std::uint32_t can = v4l2::abilities(capability);
  if ((can & V4L2_CAP_STREAMING) == 0) return 0;
  if ((can & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_M2M)) != 0) return V4L2_BUF_TYPE_VIDEO_CAPTURE;
  return (can & V4L2_CAP_VIDEO_OUTPUT) != 0 ? V4L2_BUF_TYPE_VIDEO_OUTPUT : 0;
}

/// A heap has no call that only asks: a request it cannot grant is answered by EINVAL.
bool is_heap(const v4l2::Device& device) {
  dma_heap_allocation_data none{};
  return device.control(DMA_HEAP_IOCTL_ALLOC, &none) == EINVAL;
}

}  // namespace

int LentMemory::open(const std::string& path) {
  close();
  if (const int error = owner_.open(path); error != 0) return error;
  queue_ = queue_of(owner_);
  if (queue_ != 0 || is_heap(owner_)) return 0;
  close();
  return ENOTTY;
}

int LentMemory::reserve(std::size_t count, std::size_t bytes) {
  bytes_ = bytes;
  return queue_ == 0 ? 0 : reserve_in_queue(static_cast<std::uint32_t>(count), bytes);
}

int LentMemory::reserve_in_queue(std::uint32_t count, std::size_t bytes) {
  v4l2_create_buffers create{};
  create.count = count;
  create.memory = V4L2_MEMORY_MMAP;
  create.format.type = queue_;
  if (const int error = owner_.control(VIDIOC_G_FMT, &create.format); error != 0) return error;
  v4l2_pix_format& pixels = create.format.fmt.pix;
  pixels.sizeimage = std::max(pixels.sizeimage, static_cast<std::uint32_t>(bytes));
  if (const int error = owner_.control(VIDIOC_CREATE_BUFS, &create); error != 0) return error;
  if (create.index != 0) return EBUSY;  // somebody's of this program
  return create.count < count ? ENOMEM : 0;
}

int LentMemory::lend(std::size_t index, int& file, std::size_t& size) const {
  if (queue_ == 0) {
    dma_heap_allocation_data allocation{};
    allocation.len = bytes_;
    allocation.fd_flags = O_RDWR | O_CLOEXEC;
    if (const int error = owner_.control(DMA_HEAP_IOCTL_ALLOC, &allocation); error != 0) return error;
    file = static_cast<int>(allocation.fd);
  } else if (const int error =
                 v4l2::export_buffer(owner_, queue_, static_cast<std::uint32_t>(index), O_RDWR, file);
             error != 0) {
    return error;
  }
  // A DMA-buf tells its size by its end.
  const off_t end = ::lseek(file, 0, SEEK_END);
  size = end < 0 ? 0 : static_cast<std::size_t>(end);
  return size < bytes_ ? ENOBUFS : 0;
}

void LentMemory::close() noexcept {
  owner_.close();
  queue_ = 0;
}

std::vector<std::string> dma_heaps() {
  std::vector<std::string> heaps;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator("/dev/dma_heap", error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    heaps.push_back(entry->path().string());
  std::sort(heaps.begin(), heaps.end());
  return heaps;
}

}  // namespace omma
