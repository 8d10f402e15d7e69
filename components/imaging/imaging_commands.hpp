// What the imaging component can be told, and what it tells of.
#pragma once

#include <array>

#include "components/imaging/image_chunk.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/event.hpp"

namespace omma {

inline constexpr CommandDescriptor kStartPicture{.id = 20,
                                                 .name = "start_picture",
                                                 .text = "leaves the picture under way and begins a new one",
                                                 .modes = modes(Mode::kAcquire, Mode::kTrack)};

/// The kinds that may be asked for, in the order of the choices.
inline constexpr std::array kRequestKinds{ImageKind::kPanoramaJ2000, ImageKind::kPanoramaRig,
                                          ImageKind::kView,          ImageKind::kFisheyeJ2000,
                                          ImageKind::kFisheyeRig,    ImageKind::kViewRig};
inline constexpr std::array<ValueDescriptor, limits::kCommandArguments> kLookArguments{
    {{.name = "kind",
      .type = ValueType::kChoice,
      .choices = "panorama_j2000|panorama_rig|view|fisheye_j2000|fisheye_rig|view_rig"},
     {.name = "pan", .unit = "deg", .least = -360, .most = 360},
     {.name = "tilt", .unit = "deg", .least = -90, .most = 90},
     {.name = "field", .unit = "deg", .least = 0, .most = 360}}};

inline constexpr CommandDescriptor kRequestPicture{
    .id = 22,
    .name = "request_picture",
    .text = "a picture of its own, made once after the one under way: a view looks where it is told",
    .arguments = kLookArguments,
    .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr CommandDescriptor kRequestRegion{
    .id = 23,
    .name = "request_region",
    .text = "a square of a camera's own pixels at full depth, once; size 0: to the image's right and bottom",
    .arguments = {{{.name = "camera", .type = ValueType::kInteger, .least = 0, .most = limits::kCameras - 1},
                   {.name = "left", .unit = "px", .type = ValueType::kInteger, .least = 0, .most = 16383},
                   {.name = "top", .unit = "px", .type = ValueType::kInteger, .least = 0, .most = 16383},
                   {.name = "size", .unit = "px", .type = ValueType::kInteger, .least = 0, .most = 16384}}},
    .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr CommandDescriptor kRequestFused{
    .id = 24,
    .name = "request_fused",
    .text = "as request_picture, of several frame sets with different exposures fused into one",
    .arguments = kLookArguments,
    .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr std::array kImagingCommands{kStartPicture, kRequestPicture, kRequestRegion, kRequestFused};

inline constexpr EventDescriptor kPictureNotMade{
    .id = 82,
    .severity = EventSeverity::kWarning,
    .name = "picture_not_made",
    .text = "a picture asked for was not made: {0}",
    .values = {{{.name = "reason", .choices = "it cannot be seen so|no camera tells its exposure"}}}};

inline constexpr EventDescriptor kRequestedPictureBegun{.id = 83,
                                                        .severity = EventSeverity::kActivity,
                                                        .name = "requested_picture_begun",
                                                        .text = "the picture asked for is image {0}",
                                                        .values = {{{"image"}}}};

inline constexpr EventDescriptor kNothingToFuse{
    .id = 84,
    .severity = EventSeverity::kWarning,
    .name = "nothing_to_fuse",
    .text = "the mission's picture is fused of several exposures, and no camera tells its exposure"};

inline constexpr std::array kImagingEvents{kPictureNotMade, kRequestedPictureBegun, kNothingToFuse};
static_assert(are_unique(kImagingEvents) && are_well_formed(kImagingEvents));

}  // namespace omma
