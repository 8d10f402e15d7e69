// Frames of a camera that libcamera knows: raw streams where the format is a mosaic or grey of the sensor,
// processed ones otherwise. Built where libcamera is installed, into
// a program of its own; its own types stay in the .cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/camera_setup.hpp"
#include "hal/libcamera/libcamera_child.hpp"
#include "hal/live/frame_source.hpp"

namespace omma {

class LibcameraSource final : public FrameSource {
 public:
  /// The setup's device is a camera's id or model, as `omma cameras` lists them.
  /// @throws InputError: a format that is not understood, no size
  explicit LibcameraSource(CameraSetup setup);
  ~LibcameraSource() override;
  LibcameraSource(const LibcameraSource&) = delete;
  LibcameraSource& operator=(const LibcameraSource&) = delete;

  std::string_view driver_name() const override { return "libcamera"; }
  GreyShape shape() const override { return shape_; }
  void start() override;
  void stop() noexcept override;
  Taken take(std::byte* pixels, int timeout_ms) noexcept override;

 private:
  struct Stream;  // what is open

  CameraSetup setup_;
  const PixelLayout* layout_;
  GreyShape shape_;
  std::unique_ptr<Stream> stream_;
};

/// The cameras that libcamera finds. @throws std::runtime_error where it cannot look for them
std::vector<LibcameraDescription> describe_libcameras();

}  // namespace omma
