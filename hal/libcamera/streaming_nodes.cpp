#include "hal/libcamera/streaming_nodes.hpp"

#include <linux/videodev2.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <string>

namespace omma {
namespace {

bool has_buffers(int file) noexcept {
  for (const std::uint32_t type : {V4L2_BUF_TYPE_VIDEO_CAPTURE, V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE}) {
    std::array<v4l2_plane, VIDEO_MAX_PLANES> planes{};
    v4l2_buffer buffer{};
    buffer.type = type;
    if (type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
      buffer.m.planes = planes.data();
      buffer.length = planes.size();
    }
    if (::ioctl(file, VIDIOC_QUERYBUF, &buffer) == 0) return true;
  }
  return false;
}

}  // namespace

std::vector<int> streaming_nodes() {
  std::vector<int> nodes;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator("/proc/self/fd", error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    std::error_code gone;
    const std::string node = std::filesystem::read_symlink(entry->path(), gone).string();
    const std::string name = entry->path().filename().string();
    int file = -1;
    std::from_chars(name.data(), name.data() + name.size(), file);
    if (node.starts_with("/dev/video") && has_buffers(file)) nodes.push_back(file);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

bool any_gone(const std::vector<int>& nodes) noexcept {
  return std::any_of(nodes.begin(), nodes.end(), [](int file) {
    v4l2_capability capability{};
    return ::ioctl(file, VIDIOC_QUERYCAP, &capability) != 0 && errno == ENODEV;
  });
}

}  // namespace omma
