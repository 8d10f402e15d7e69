// Compile-time maxima: every buffer of the flight program is sized here. A configuration that asks for
// more is refused at start-up with the name of the limit; data that exceeds one keeps the best and counts
// the rest.
#pragma once

#include <cstddef>

namespace omma::limits {

inline constexpr int kCameras = 6;                  // cameras of one rig
inline constexpr int kImageSide = 4096;             // width or height of one image [px]
inline constexpr std::size_t kDotsPerCamera = 512;  // dots kept per image, brightest first
inline constexpr int kTargetBodies = 4;             // bodies with fiducials
inline constexpr std::size_t kTargetsPerBody = 64;  // fiducials of one body
inline constexpr std::size_t kStarPairs = 768;      // stars paired per frame set, all cameras
inline constexpr std::size_t kTargetPairs = kTargetsPerBody * kCameras;
inline constexpr std::size_t kRateMeasurements = 64;   // of a gyro, between two frame sets
inline constexpr std::size_t kImageChunkBytes = 8192;  // pixels of one image chunk sent to the ground
inline constexpr std::size_t kRateGroups = 8;          // rate groups of the schedule
inline constexpr std::size_t kComponents = 32;         // components of the schedule, all rate groups
inline constexpr std::size_t kEventIds = 512;          // event ids are below this
inline constexpr std::size_t kEventValues = 4;         // numbers an event carries
inline constexpr std::size_t kNameLength = 31;         // characters of a camera, body or spacecraft name

}  // namespace omma::limits
