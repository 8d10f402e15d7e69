#include "ground/feed/video_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fsw/kernel/input_error.hpp"

namespace omma::ground {
namespace {

// v4l2loopback gives a pixel of Y10 or Y12 ten or twelve bits of room, not the two bytes they have: Y16 for
// all.
std::uint32_t format_of(const ImageView& image) {
  return image.format == PixelFormat::kGrey8 ? V4L2_PIX_FMT_GREY : V4L2_PIX_FMT_Y16;
}

std::size_t bytes_of(const ImageView& image) {
  return static_cast<std::size_t>(image.stride) * static_cast<std::size_t>(image.height);
}

}  // namespace

VideoOutput::VideoOutput(const std::string& device, const ImageView& like) : path_(device) {
  if (const int error = device_.open(path_); error != 0)
    throw InputError(path_, 0, "device", "a video device", std::strerror(error));
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(like.width);
  pixels.height = static_cast<std::uint32_t>(like.height);
  pixels.pixelformat = format_of(like);
  pixels.field = V4L2_FIELD_NONE;
  pixels.bytesperline = static_cast<std::uint32_t>(like.stride);
  pixels.sizeimage = static_cast<std::uint32_t>(bytes_of(like));
  const std::uint32_t wanted = pixels.pixelformat;
  const int error = device_.control(VIDIOC_S_FMT, &format);
  if (error != 0 || pixels.pixelformat != wanted || pixels.width != static_cast<std::uint32_t>(like.width) ||
      pixels.height != static_cast<std::uint32_t>(like.height)) {
    throw InputError(path_, 0, "device",
                     "one that takes frames of " + std::to_string(like.width) + " x " +
                         std::to_string(like.height) + " px, " + v4l2::fourcc_name(wanted),
                     error != 0 ? std::strerror(error) : "another format");
  }
}

void VideoOutput::write(const ImageView& image) const {
  ssize_t written = 0;
  do {
    written = ::write(device_.file(), image.data, bytes_of(image));
  } while (written < 0 && errno == EINTR);
  if (written < 0) throw InputError(path_, 0, "device", "a device that takes a frame", std::strerror(errno));
  if (written != static_cast<ssize_t>(bytes_of(image))) {
    throw InputError(path_, 0, "device", "room for " + std::to_string(bytes_of(image)) + " bytes",
                     "room for " + std::to_string(written));
  }
}

std::int64_t VideoOutput::control(const std::string& name, std::int64_t otherwise) const {
  for (const v4l2::Control& control : v4l2::controls_of(device_))
    if (control.name == name) return control.value;
  return otherwise;
}

}  // namespace omma::ground
