#include "hal/v4l2/v4l2_device.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace omma::v4l2 {
namespace {

// A name in a fixed field of the kernel's, ended by a zero or by the field.
template <std::size_t kSize>
std::string text_of(const __u8 (&field)[kSize]) {
  const char* const begin = reinterpret_cast<const char*>(field);
  return {begin, ::strnlen(begin, kSize)};
}
template <std::size_t kSize>
std::string text_of(const char (&field)[kSize]) {
  return {field, ::strnlen(field, kSize)};
}

std::string key_of(const std::string& name) {
  std::string key;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!key.empty() && key.back() != '_') {
      key += '_';
    }
  }
  while (!key.empty() && key.back() == '_') key.pop_back();
  return key;
}

bool is_number(std::uint32_t type) {
  return type == V4L2_CTRL_TYPE_INTEGER || type == V4L2_CTRL_TYPE_BOOLEAN || type == V4L2_CTRL_TYPE_MENU ||
         type == V4L2_CTRL_TYPE_BUTTON || type == V4L2_CTRL_TYPE_INTEGER64 ||
         type == V4L2_CTRL_TYPE_BITMASK || type == V4L2_CTRL_TYPE_INTEGER_MENU;
}

void read_items(const Device& device, Control& control) {
  for (std::int64_t index = control.least; index <= control.most; ++index) {
    v4l2_querymenu item{};
    item.id = control.id;
    item.index = static_cast<std::uint32_t>(index);
    if (device.control(VIDIOC_QUERYMENU, &item) != 0) continue;
    control.items.emplace_back(
        index, control.type == V4L2_CTRL_TYPE_MENU ? text_of(item.name) : std::to_string(item.value));
  }
}

void read_value(const Device& device, Control& control) {
  v4l2_ext_control value{};
  value.id = control.id;
  v4l2_ext_controls one{};
  one.which = V4L2_CTRL_WHICH_CUR_VAL;
  one.count = 1;
  one.controls = &value;
  if (device.control(VIDIOC_G_EXT_CTRLS, &one) != 0) return;
  control.value = control.type == V4L2_CTRL_TYPE_INTEGER64 ? value.value64 : value.value;
}

std::vector<std::string> sizes_of(const Device& device, std::uint32_t fourcc) {
  std::vector<std::string> sizes;
  v4l2_frmsizeenum size{};
  size.pixel_format = fourcc;
  for (; device.control(VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
    const auto text = [](unsigned width, unsigned height) {
      return std::to_string(width) + " x " + std::to_string(height);
    };
    if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      sizes.push_back(text(size.discrete.width, size.discrete.height));
    } else {
      sizes.push_back(text(size.stepwise.min_width, size.stepwise.min_height) + " to " +
                      text(size.stepwise.max_width, size.stepwise.max_height));
      break;
    }
  }
  return sizes;
}

int request_buffers(const Device& device, std::uint32_t memory, std::uint32_t count) {
  v4l2_requestbuffers request{};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = memory;
  request.count = count;
  return device.control(VIDIOC_REQBUFS, &request);
}

// Tried, with buffers of the format it has: the kernel has no call that only asks.
std::string memory_of(const Device& device) {
  if (const int error = request_buffers(device, V4L2_MEMORY_MMAP, 2); error == EBUSY) {
    return "not known while another program uses it";
  } else if (error != 0) {
    return "no buffers (" + std::string(std::strerror(error)) + ")";
  }
  std::string memory = "mmap";
  if (int file = -1; export_buffer(device, V4L2_BUF_TYPE_VIDEO_CAPTURE, 0, O_RDONLY, file) == 0) {
    ::close(file);
    memory += ", dma-buf";
  }
  request_buffers(device, V4L2_MEMORY_MMAP, 0);
  if (request_buffers(device, V4L2_MEMORY_DMABUF, 0) == 0) memory += ", dma-buf of another owner's";
  return memory;
}

}  // namespace

int Device::open(const std::string& path) noexcept {
  close();
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return errno;
  if (!S_ISCHR(about.st_mode)) return ENOTTY;
  file_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  return file_ < 0 ? errno : 0;
}

void Device::close() noexcept {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

int Device::control(unsigned long request, void* argument) const noexcept {
  for (;;) {
    if (::ioctl(file_, request, argument) == 0) return 0;
    if (errno != EINTR) return errno;
  }
}

std::uint32_t abilities(const v4l2_capability& capability) {
  return (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps
                                                               : capability.capabilities;
}

bool captures(const Device& device, v4l2_capability& capability) {
  capability = {};
  if (device.control(VIDIOC_QUERYCAP, &capability) != 0) return false;
  const std::uint32_t can = abilities(capability);
  return (can & V4L2_CAP_VIDEO_CAPTURE) != 0 && (can & V4L2_CAP_STREAMING) != 0;
}

std::vector<Control> controls_of(const Device& device) {
  std::vector<Control> controls;
  v4l2_query_ext_ctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (device.control(VIDIOC_QUERY_EXT_CTRL, &query) == 0) {
    if (is_number(query.type) && (query.flags & V4L2_CTRL_FLAG_DISABLED) == 0) {
      Control control{.id = query.id,
                      .type = query.type,
                      .name = key_of(text_of(query.name)),
                      .least = query.minimum,
                      .most = query.maximum,
                      .step = query.step,
                      .usual = query.default_value,
                      .read_only = (query.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0};
      if (query.type == V4L2_CTRL_TYPE_MENU || query.type == V4L2_CTRL_TYPE_INTEGER_MENU)
        read_items(device, control);
      if (query.type != V4L2_CTRL_TYPE_BUTTON) read_value(device, control);
      controls.push_back(std::move(control));
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  return controls;
}

Description describe(const Device& device, const std::string& path) {
  Description description;
  description.path = path;
  v4l2_capability capability{};
  if (device.control(VIDIOC_QUERYCAP, &capability) == 0) {
    description.card = text_of(capability.card);
    description.bus = text_of(capability.bus_info);
    description.driver = text_of(capability.driver);
  }
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; device.control(VIDIOC_ENUM_FMT, &format) == 0; ++format.index)
    description.formats.push_back(
        {fourcc_name(format.pixelformat), text_of(format.description), sizes_of(device, format.pixelformat)});
  description.controls = controls_of(device);
  description.memory = memory_of(device);
  return description;
}

std::vector<std::string> device_paths() {
  std::vector<std::pair<int, std::string>> found;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator("/dev", error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    constexpr std::string_view kStart = "video";
    int number = 0;
    if (name.rfind(kStart, 0) != 0) continue;
    const auto [end, wrong] = std::from_chars(name.data() + kStart.size(), name.data() + name.size(), number);
    if (wrong == std::errc{} && end == name.data() + name.size())
      found.emplace_back(number, entry->path().string());
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> paths;
  paths.reserve(found.size());
  for (auto& [number, path] : found) paths.push_back(std::move(path));
  return paths;
}

std::string find_device(const std::string& name) {
  if (!name.empty() && name.front() == '/') return name;
  for (const std::string& path : device_paths()) {
    Device device;
    v4l2_capability capability{};
    if (device.open(path) == 0 && captures(device, capability) &&
        (text_of(capability.card) == name || text_of(capability.bus_info) == name))
      return path;
  }
  return {};
}

int export_buffer(const Device& device, std::uint32_t type, std::uint32_t index, int access,
                  int& file) noexcept {
  v4l2_exportbuffer exported{};
  exported.type = type;
  exported.index = index;
  exported.flags = static_cast<std::uint32_t>(access | O_CLOEXEC);
  const int error = device.control(VIDIOC_EXPBUF, &exported);
  if (error == 0) file = exported.fd;
  return error;
}

int set_control(const Device& device, const Control& control, std::int64_t value) noexcept {
  v4l2_ext_control setting{};
  setting.id = control.id;
  if (control.type == V4L2_CTRL_TYPE_INTEGER64) {
    setting.value64 = value;
  } else {
    setting.value = static_cast<std::int32_t>(value);
  }
  v4l2_ext_controls one{};
  one.which = V4L2_CTRL_WHICH_CUR_VAL;
  one.count = 1;
  one.controls = &setting;
  return device.control(VIDIOC_S_EXT_CTRLS, &one);
}

std::string fourcc_name(std::uint32_t fourcc) {
  std::string name;
  for (unsigned shift = 0; shift < 32; shift += 8) name += static_cast<char>((fourcc >> shift) & 0x7FU);
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
}

std::uint32_t fourcc_of(std::string_view name) {
  std::uint32_t fourcc = 0;
  for (unsigned i = 0; i < 4; ++i)
    fourcc |= static_cast<std::uint32_t>(i < name.size() ? static_cast<unsigned char>(name[i]) : ' ')
              << (8 * i);
  return fourcc;
}

}  // namespace omma::v4l2
