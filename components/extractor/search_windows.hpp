// Where dots are expected in the images of a frame set: what the look-out writes and the extractor reads.
#pragma once

#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct SearchWindow {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< inclusive; parts may lie outside the image [px]
};

struct CameraWindows {
  bool everywhere = true;  ///< the whole image is searched, whatever the windows
  StaticVector<SearchWindow, limits::kDotsPerCamera> windows;
};

struct SearchWindows {
  StaticVector<CameraWindows, limits::kCameras> cameras;  ///< in the order of the rig
};

}  // namespace omma
