#include "ground/feed/video_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fsw/kernel/input_error.hpp"

namespace omma::ground {
namespace {

std::uint32_t format_of(const ImageView& image) {
  if (image.format == PixelFormat::kGrey8) return V4L2_PIX_FMT_GREY;
  if (image.white_level <= 1023) return V4L2_PIX_FMT_Y10;
  return image.white_level <= 4095 ? V4L2_PIX_FMT_Y12 : V4L2_PIX_FMT_Y16;
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
  if (written != static_cast<ssize_t>(bytes_of(image)))
    throw InputError(path_, 0, "device", "a device that takes a frame", std::strerror(errno));
}

std::int64_t VideoOutput::control(const std::string& name, std::int64_t otherwise) const {
  for (const v4l2::Control& control : v4l2::controls_of(device_))
    if (control.name == name) return control.value;
  return otherwise;
}

}  // namespace omma::ground
