// The driver libcamera, in processes of its own (the program omma-libcamera beside this one): libcamera
// brings two dozen libraries and threads with it, and does not outlive a camera that is unplugged. The frames
// come through shared memory; where a process dies its camera is gone, and a new one looks for it.
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

/// A source that is not started yet. Its `start` starts the process where none runs, and waits until the
/// camera streams.
/// @throws InputError: a setup it cannot use; from `start` what the process says, or that there is no such
/// program (libcamera was not installed when this was built)
std::unique_ptr<FrameSource> make_libcamera_source(const CameraSetup& setup);
/// The cameras of this machine. @throws InputError as above
std::vector<LibcameraDescription> list_libcameras();

}  // namespace omma
