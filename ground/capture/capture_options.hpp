// What `omma capture` is told: which cameras, set up how. From a mission file, or from the command line.
#pragma once

#include <string>
#include <vector>

#include "hal/camera_setup.hpp"

namespace omma::ground {

struct CaptureCamera {
  std::string name;
  std::string driver;
  CameraSetup setup;
};

struct CaptureArguments {
  std::string mission;
  std::vector<std::string> cameras;  ///< NAME=DRIVER:DEVICE
  std::string size = "640x480";      ///< of the images, after binning
  std::string format = "GREY";
  std::string bayer = "grey";
  std::string memory = "mmap";
  std::string memory_from;
  double rate_hz = 0;
  int buffers = 8;
  int timeout_ms = 2000;
  std::vector<std::string> controls;  ///< NAME=VALUE
};

/// The mission's live cameras, or those of the command line.
/// @throws InputError: none, both, or words that are not understood
std::vector<CaptureCamera> capture_cameras(const CaptureArguments& arguments);

}  // namespace omma::ground
