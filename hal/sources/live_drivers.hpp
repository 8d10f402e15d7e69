// The live camera drivers by name: the one place that knows them all.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/camera_setup.hpp"
#include "hal/live/frame_source.hpp"

namespace omma {

/// The names that a mission's `driver` may have, besides "recorded".
std::vector<std::string_view> live_drivers();

/// A source that is not started yet.
/// @throws InputError: no driver of that name, or a setup it cannot use
std::unique_ptr<FrameSource> make_frame_source(const std::string& driver, const CameraSetup& setup);

}  // namespace omma
