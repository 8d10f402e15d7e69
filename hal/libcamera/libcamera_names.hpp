// libcamera's pixel formats and controls by our names.
#pragma once

#include <libcamera/libcamera.h>

#include <string>

#include "hal/camera_setup.hpp"
#include "hal/live/pixel_layout.hpp"

namespace omma {

/// libcamera names formats as DRM does: RGB888 lies in memory as blue, green, red.
libcamera::PixelFormat libcamera_format(const PixelLayout& layout);
/// Our name of a format; libcamera's where we have none.
std::string format_name(const libcamera::PixelFormat& format);
/// Raw: what the sensor gives; otherwise what the pipeline makes of it.
bool is_raw(const PixelLayout& layout);

/// The setup's controls as libcamera takes them. "exposure" is ExposureTime [us], "gain" AnalogueGain; other
/// names are libcamera's.
/// @throws InputError: a control the camera does not have, or a value that is not one or out of its range
void read_libcamera_controls(const CameraSetup& setup, const libcamera::ControlInfoMap& known,
                             libcamera::ControlList& controls);

}  // namespace omma
