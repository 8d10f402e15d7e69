// A video device file by its system calls, and what a device says of itself: name, formats, controls.
// Source: Linux kernel, Documentation/userspace-api/media/v4l.
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace omma::v4l2 {

struct Control {
  std::uint32_t id = 0;
  std::uint32_t type = 0;  ///< V4L2_CTRL_TYPE_...
  std::string name;        ///< lower case, words joined by '_', as v4l2-ctl writes it
  std::int64_t least = 0;
  std::int64_t most = 0;
  std::uint64_t step = 1;
  std::int64_t usual = 0;
  std::int64_t value = 0;
  bool read_only = false;
  std::vector<std::pair<std::int64_t, std::string>> items{};  ///< of a menu
};

struct Format {
  std::string name;         ///< fourcc, trailing spaces left out
  std::string description;  ///< the driver's words
  std::vector<std::string> sizes;
};

struct Description {
  std::string path;
  std::string card;
  std::string bus;
  std::string driver;
  std::vector<Format> formats;
  std::vector<Control> controls;
  std::string
      memory;  ///< what its buffers can be: "mmap, dma-buf, dma-buf of another owner's", or why unknown
};

/// An open device; every call is repeated where a signal broke it.
class Device {
 public:
  Device() = default;
  ~Device() { close(); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// @return 0, or the errno
  int open(const std::string& path) noexcept;
  void close() noexcept;
  bool is_open() const noexcept { return file_ >= 0; }
  int file() const noexcept { return file_; }
  /// @return 0, or the errno
  int control(unsigned long request, void* argument) const noexcept;

 private:
  int file_ = -1;
};

/// V4L2_CAP_... of this node, where the driver tells them apart from those of all its nodes.
std::uint32_t abilities(const v4l2_capability& capability);
/// True for a device that captures into one plane by streaming.
bool captures(const Device& device, v4l2_capability& capability);
/// Every control that can be set or read as a number, buttons included.
std::vector<Control> controls_of(const Device& device);
Description describe(const Device& device, const std::string& path);
/// The paths of all video devices of the machine, by their numbers.
std::vector<std::string> device_paths();
/// The path itself, or that of the first device whose card or bus is called `name`; empty where there is
/// none.
std::string find_device(const std::string& name);
/// A buffer of the device's queue `type` as a DMA-buf, for the caller to close.
/// @param access  O_RDONLY or O_RDWR
/// @return 0, or the errno; then `file` is as it was
int export_buffer(const Device& device, std::uint32_t type, std::uint32_t index, int access,
                  int& file) noexcept;
/// @return 0, or the errno
int set_control(const Device& device, const Control& control, std::int64_t value) noexcept;
std::string fourcc_name(std::uint32_t fourcc);
std::uint32_t fourcc_of(std::string_view name);

}  // namespace omma::v4l2
