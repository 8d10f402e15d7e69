// The driver libcamera, from a module of its own (omma-libcamera.so beside the program): libcamera brings two
// dozen libraries and threads with it, which a program without such a camera never sees.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/camera_setup.hpp"
#include "hal/live/frame_source.hpp"

namespace omma {

struct LibcameraDescription {
  std::string id;
  std::string model;
  std::vector<std::string>
      formats;  ///< "raw BG10: 640 x 480, ..." in our names; libcamera's where we have none
  std::vector<std::string> controls;  ///< "AnalogueGain: [1.0..16.0]"
};

/// A source that is not started yet.
/// @throws InputError: a setup it cannot use, or no module (libcamera was not installed when this was built)
std::unique_ptr<FrameSource> make_libcamera_source(const CameraSetup& setup);
/// The cameras of this machine. @throws InputError as above, std::runtime_error where libcamera cannot look
/// for them
std::vector<LibcameraDescription> list_libcameras();

// What the module holds.
using MakeLibcameraSource = FrameSource*(const CameraSetup&);
using ListLibcameras = void(std::vector<LibcameraDescription>&);

}  // namespace omma
