#include "hal/v4l2/v4l2_source.hpp"

#include <fcntl.h>
#include <linux/dma-buf.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <utility>

#include "fsw/kernel/input_error.hpp"
#include "hal/v4l2/v4l2_controls.hpp"

namespace omma {
namespace {

constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

constexpr TimeNs kExposureUnitNs = 100'000;  // of V4L2_CID_EXPOSURE_ABSOLUTE

std::string format_text(const std::string& name, unsigned width, unsigned height) {
  return name + " of " + std::to_string(width) + " x " + std::to_string(height) + " px";
}

// Drivers that do not say which clock they stamp by are believed where it can be the monotonic one; for
// others it is the instant the frame is taken out.
TimeNs stamp_of(const v4l2_buffer& filled) {
  constexpr TimeNs kSecond = 1'000'000'000;
  const TimeNs stamp = TimeNs{filled.timestamp.tv_sec} * kSecond + TimeNs{filled.timestamp.tv_usec} * 1000;
  const std::uint32_t clock = filled.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK;
  if (clock == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) return stamp;
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const TimeNs now = TimeNs{time.tv_sec} * kSecond + time.tv_nsec;
  const bool plausible = stamp <= now && stamp > now - kSecond;
  return clock == V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN && plausible ? stamp : now;
}

// Caches are brought up to date where the machine needs it. False where the memory's owner cannot.
bool mark_reading(int dma_file, std::uint64_t when) {
  constexpr int kAttempts = 100;  // a signal, or a fence still waited for
  dma_buf_sync sync{};
  sync.flags = DMA_BUF_SYNC_READ | when;
  for (int i = 0; i < kAttempts; ++i) {
    if (::ioctl(dma_file, DMA_BUF_IOCTL_SYNC, &sync) == 0) return true;
    if (errno != EINTR && errno != EAGAIN) return false;
  }
  return false;
}

}  // namespace

V4l2Source::V4l2Source(CameraSetup setup)
    : setup_(std::move(setup)), layout_(&layout_of(setup_)), shape_(shape_of(setup_)) {
  if (setup_.buffers < 2 || setup_.buffers > 32) refuse("buffers", "2 to 32", std::to_string(setup_.buffers));
  if (borrows() && !setup_.dma_buf) refuse("memory_from", R"(memory = "dma-buf")", R"("mmap")");
}

void V4l2Source::refuse(std::string_view field, const std::string& expected, const std::string& found) const {
  throw InputError(setup_.where, 0, field, expected, found);
}

void V4l2Source::require(int error, std::string_view field, const std::string& expected) const {
  if (error != 0) refuse(field, expected, std::string(std::strerror(error)));
}

void V4l2Source::start() {
  stop();
  try {
    open();
    set_format();
    set_rate();
    v4l2::apply_controls(device_, setup_);
    find_exposure();
    request_buffers();
    map_buffers();
    int type = kCapture;
    require(device_.control(VIDIOC_STREAMON, &type), "device", "a stream from " + setup_.device);
    streaming_ = true;
  } catch (...) {
    stop();
    throw;
  }
}

void V4l2Source::open() {
  const std::string path = v4l2::find_device(setup_.device);
  if (path.empty()) refuse("device", "the card or bus of a video device", setup_.device);
  require(device_.open(path), "device", "the video device " + path);
  v4l2_capability capability{};
  if (!v4l2::captures(device_, capability))
    refuse("device", "a video device that captures by streaming", path + ", which does not");
}

void V4l2Source::set_format() {
  const int cell = binning(*layout_, setup_.bayer);
  v4l2_format format{};
  format.type = kCapture;
  format.fmt.pix.width = static_cast<std::uint32_t>(cell * setup_.width);
  format.fmt.pix.height = static_cast<std::uint32_t>(cell * setup_.height);
  format.fmt.pix.pixelformat = v4l2::fourcc_of(layout_->name);
  format.fmt.pix.field = V4L2_FIELD_NONE;
  const std::string wanted = format_text(setup_.format, format.fmt.pix.width, format.fmt.pix.height);
  require(device_.control(VIDIOC_S_FMT, &format), "format", wanted);
  const std::string given =
      format_text(v4l2::fourcc_name(format.fmt.pix.pixelformat), format.fmt.pix.width, format.fmt.pix.height);
  if (given != wanted) refuse("format", wanted + " from " + setup_.device, given);
  const auto packed = std::ptrdiff_t{layout_->bytes} * static_cast<std::ptrdiff_t>(format.fmt.pix.width);
  stride_ = std::max(packed, static_cast<std::ptrdiff_t>(format.fmt.pix.bytesperline));
  frame_bytes_ = format.fmt.pix.sizeimage;
}

void V4l2Source::set_rate() const {
  if (setup_.frame_rate_hz <= 0) return;
  v4l2_streamparm parameters{};
  parameters.type = kCapture;
  parameters.parm.capture.timeperframe = {
      1000, static_cast<std::uint32_t>(std::lround(setup_.frame_rate_hz * 1000))};
  // A device with one rate only, or one that is triggered, refuses; its frames are matched by time all the
  // same.
  device_.control(VIDIOC_S_PARM, &parameters);
}

void V4l2Source::find_exposure() {
  exposure_ = {};
  for (const v4l2::Control& control : v4l2::controls_of(device_))
    if (control.id == V4L2_CID_EXPOSURE_ABSOLUTE && !control.read_only) exposure_ = control;
  exposure_ns_ = exposure_.value * kExposureUnitNs;
}

CameraSettingsRange V4l2Source::settings_range() const {
  return {{.exposure_ns = exposure_.least * kExposureUnitNs},
          {.exposure_ns = exposure_.most * kExposureUnitNs}};
}

bool V4l2Source::apply(const CameraSettings& settings) noexcept {
  const std::int64_t units = settings.exposure_ns / kExposureUnitNs;
  if (exposure_.id == 0 || v4l2::set_control(device_, exposure_, units) != 0) return false;
  exposure_ns_ = settings.exposure_ns;
  return true;
}

v4l2_buffer V4l2Source::buffer_query(std::uint32_t index) const noexcept {
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = borrows() ? V4L2_MEMORY_DMABUF : V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

void V4l2Source::request_buffers() {
  v4l2_requestbuffers request{};
  request.type = kCapture;
  request.memory = borrows() ? V4L2_MEMORY_DMABUF : V4L2_MEMORY_MMAP;
  request.count = static_cast<std::uint32_t>(setup_.buffers);
  require(device_.control(VIDIOC_REQBUFS, &request), borrows() ? "memory_from" : "buffers",
          borrows() ? setup_.device + " to fill memory of another owner's"
                    : "memory for frames of " + setup_.device);
  if (request.count < 2) refuse("buffers", "at least 2 of " + setup_.device, std::to_string(request.count));
  buffers_.resize(request.count);
  if (borrows()) borrow_buffers();
}

void V4l2Source::borrow_buffers() {
  if (const int error = lender_.open(setup_.memory_from); error != 0)
    refuse("memory_from", "a DMA heap or a video device that exports its buffers",
           setup_.memory_from + ": " + std::strerror(error));
  const std::string wanted = std::to_string(buffers_.size()) + " DMA-bufs of " +
                             std::to_string(frame_bytes_) + " bytes from " + setup_.memory_from;
  require(lender_.reserve(buffers_.size(), frame_bytes_), "memory_from", wanted);
  for (std::size_t i = 0; i < buffers_.size(); ++i)
    require(lender_.lend(i, buffers_[i].dma_file, buffers_[i].size), "memory_from", wanted);
}

void V4l2Source::map_buffers() {
  for (std::uint32_t i = 0; i < buffers_.size(); ++i) {
    Buffer& buffer = buffers_[i];
    if (borrows()) {
      map(buffer, buffer.dma_file, 0);
    } else {
      v4l2_buffer about = buffer_query(i);
      require(device_.control(VIDIOC_QUERYBUF, &about), "buffers", "buffers of " + setup_.device);
      buffer.size = about.length;
      if (setup_.dma_buf) {
        require(v4l2::export_buffer(device_, kCapture, i, O_RDONLY, buffer.dma_file), "buffers",
                "a device that exports DMA-buf; use \"mmap\" where it does not");
        map(buffer, buffer.dma_file, 0);
      } else {
        map(buffer, device_.file(), about.m.offset);
      }
    }
    if (const int error = queue(i); error != 0)
      refuse(borrows() ? "memory_from" : "buffers", "buffers that " + setup_.device + " takes",
             (borrows() ? "those of " + setup_.memory_from + ": " : "") + std::strerror(error));
  }
}

void V4l2Source::map(Buffer& buffer, int file, off_t offset) {
  void* const memory = ::mmap(nullptr, buffer.size, PROT_READ, MAP_SHARED, file, offset);
  if (memory == MAP_FAILED) refuse("buffers", "buffers that can be mapped", std::strerror(errno));
  buffer.memory = memory;
}

int V4l2Source::queue(std::uint32_t index) const noexcept {
  v4l2_buffer buffer = buffer_query(index);
  if (borrows()) {
    buffer.m.fd = buffers_[index].dma_file;
    buffer.length = static_cast<std::uint32_t>(buffers_[index].size);
  }
  return device_.control(VIDIOC_QBUF, &buffer);
}

void V4l2Source::stop() noexcept {
  if (streaming_) {
    int type = kCapture;
    device_.control(VIDIOC_STREAMOFF, &type);
  }
  streaming_ = false;
  for (const Buffer& buffer : buffers_) {
    if (buffer.memory != nullptr) ::munmap(buffer.memory, buffer.size);
    if (buffer.dma_file >= 0) ::close(buffer.dma_file);
  }
  buffers_.clear();
  device_.close();
  lender_.close();
}

bool V4l2Source::holds_whole_image(const v4l2_buffer& filled) const noexcept {
  const int rows = binning(*layout_, setup_.bayer) * shape_.height;
  return (filled.flags & V4L2_BUF_FLAG_ERROR) == 0 &&
         static_cast<std::ptrdiff_t>(filled.bytesused) >= rows * stride_ &&
         static_cast<std::ptrdiff_t>(buffers_[filled.index].size) >= rows * stride_;
}

bool V4l2Source::read_out(const Buffer& buffer, std::byte* pixels) const noexcept {
  if (buffer.dma_file >= 0 && !mark_reading(buffer.dma_file, DMA_BUF_SYNC_START)) return false;
  to_grey(*layout_, setup_.bayer, static_cast<const std::byte*>(buffer.memory), stride_, shape_, pixels);
  return buffer.dma_file < 0 || mark_reading(buffer.dma_file, DMA_BUF_SYNC_END);
}

Taken V4l2Source::take(std::byte* pixels, int timeout_ms) noexcept {
  pollfd wait{device_.file(), POLLIN, 0};
  const int ready = ::poll(&wait, 1, timeout_ms);
  if (ready == 0 || (ready < 0 && errno == EINTR)) return {};
  if (ready < 0) return {.status = TakeStatus::kGone};
  v4l2_buffer filled = buffer_query(0);
  if (const int error = device_.control(VIDIOC_DQBUF, &filled); error != 0) {
    // Without a frame in spite of poll: not an end where the device only says so once.
    return {.status = error == EAGAIN && (wait.revents & (POLLERR | POLLHUP)) == 0 ? TakeStatus::kSilence
                                                                                   : TakeStatus::kGone};
  }
  Taken taken{TakeStatus::kDamaged, stamp_of(filled), filled.sequence};
  if (filled.index >= buffers_.size()) return {.status = TakeStatus::kGone};
  if (holds_whole_image(filled) && read_out(buffers_[filled.index], pixels))
    taken.status = TakeStatus::kFrame;
  if (queue(filled.index) != 0) taken.status = TakeStatus::kGone;
  return taken;
}

}  // namespace omma
