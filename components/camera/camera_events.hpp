// What the camera component tells of its cameras.
#pragma once

#include "fsw/services/event.hpp"

namespace omma {

inline constexpr EventDescriptor kCameraLost{
    .id = 40,
    .severity = EventSeverity::kFailure,
    .name = "camera_lost",
    .text = "camera {0} is gone or silent; it is looked for; {1} times since the start",
    .values = {{{"camera"}, {"count"}}}};

inline constexpr EventDescriptor kCameraBack{.id = 41,
                                             .severity = EventSeverity::kActivity,
                                             .name = "camera_back",
                                             .text = "camera {0} delivers again",
                                             .values = {{{"camera"}}}};

inline constexpr EventDescriptor kCameraFramesLost{
    .id = 42,
    .severity = EventSeverity::kWarning,
    .name = "camera_frames_lost",
    .text = "camera {0}: {1} frames numbered but never given, {2} damaged, {3} without room",
    .values = {{{"camera"}, {"gaps"}, {"damaged"}, {"overrun"}}}};

inline constexpr EventDescriptor kCameraFramesUnmatched{
    .id = 43,
    .severity = EventSeverity::kWarning,
    .name = "camera_frames_unmatched",
    .text = "camera {0}: {1} frames too late for their trigger, or of none",
    .values = {{{"camera"}, {"count"}}}};

inline constexpr std::array kCameraEvents{kCameraLost, kCameraBack, kCameraFramesLost,
                                          kCameraFramesUnmatched};
static_assert(are_unique(kCameraEvents) && are_well_formed(kCameraEvents));

}  // namespace omma
