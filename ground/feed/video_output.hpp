// A V4L2 device that takes frames from a program (v4l2loopback) and gives them to whoever opens it as a
// camera.
#pragma once

#include <string>

#include "hal/image.hpp"
#include "hal/v4l2/v4l2_device.hpp"

namespace omma::ground {

class VideoOutput {
 public:
  /// @param like  an image like all that will be written: 8 bits become GREY, more Y10, Y12 or Y16 by its
  /// white level
  /// @throws InputError: no such device, or one that does not take such frames
  VideoOutput(const std::string& device, const ImageView& like);
  /// An image of packed rows. @throws InputError where the device does not take it
  void write(const ImageView& image) const;
  /// The value that the device's reader has set; `otherwise` where the device has no such control.
  std::int64_t control(const std::string& name, std::int64_t otherwise) const;

 private:
  std::string path_;
  v4l2::Device device_;
};

}  // namespace omma::ground
