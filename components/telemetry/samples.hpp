// The components' messages as telemetry samples: values in, the C structs of the IDL out. Pure copying;
// nothing is allocated, and what a sequence points at is the caller's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

#include "components/approach/approach_estimate.hpp"
#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/exposure/exposure_report.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/imaging/image_chunk.hpp"
#include "components/motion/motion_report.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/surveillance/unknown_objects.hpp"
#include "components/telemetry/omma.h"
#include "components/telemetry/spacecraft_status.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/services/commander.hpp"
#include "fsw/services/health.hpp"
#include "fsw/services/parameters.hpp"
#include "fsw/services/utc_correlation.hpp"

namespace omma::telemetry {

/// Copies as many characters as fit and ends the text.
template <std::size_t kSize>
void set_text(char (&out)[kSize], std::string_view text) noexcept {
  const std::size_t size = std::min(text.size(), kSize - 1);
  *std::copy_n(text.begin(), size, out) = '\0';
}

// Each fills its whole sample except sample_number, which the sender counts.

/// @param out  `cameras` holds room for as many cameras as the rig has; their names are left as they are
void fill(const Frames& frames, const DotLists& dots, const Pairings& pairings, omma_FrameSet& out) noexcept;

/// What automatic exposure did, into the cameras of a frame set that is filled.
void fill(const ExposureReport& report, omma_FrameSet& out) noexcept;

/// No dot is claimed yet: see `claim`.
/// @param out  `dots` holds room for limits::kDotsPerCamera
void fill(const DotLists& lists, std::size_t camera, omma_CameraDots& out) noexcept;

/// Writes role, body, entry, culled, residual, persistence and age into the dots of all cameras (index in the
/// rig) that a star or a planet claims.
void claim(const SkyPairings& sky, const AttitudeEstimate& attitude,
           std::span<omma_CameraDots> cameras) noexcept;
/// The same for the targets of a body. @param pose  null where the body was not solved
void claim(const BodyPairings& body, const PoseEstimate* pose, std::span<omma_CameraDots> cameras) noexcept;

/// Names the dots in which an unknown object was seen.
void claim(const UnknownObjects& objects, std::span<omma_CameraDots> cameras) noexcept;

void fill(const AttitudeEstimate& attitude, omma_Attitude& out) noexcept;
void fill(const PoseEstimate& pose, std::string_view body_name, omma_RelativePose& out) noexcept;
void fill(const ApproachEstimate& approach, std::string_view body_name, omma_Approach& out) noexcept;
/// @param out  `objects` holds room for limits::kUnknownObjects
void fill(const UnknownObjects& objects, omma_UnknownObjects& out) noexcept;
/// @param out  `groups` holds room for limits::kRateGroups
void fill(const HealthReport& health, omma_Health& out) noexcept;
/// @param out  `steps` holds room for limits::kComponents
void fill(const TimingReport& timing, omma_Timing& out) noexcept;
void fill(const UtcReport& utc, omma_UtcCorrelation& out) noexcept;
/// @param out  `pixels` holds room for limits::kImageChunkBytes
void fill(const ImageChunk& chunk, omma_ImageChunk& out) noexcept;
/// @param out  `axes` holds room for as many as the gimbal has; their names are left as they are
void fill(const MotionReport& motion, omma_Motion& out) noexcept;
/// The text is left as it is: it is made off the real-time path.
void fill(const CommandAck& ack, omma_CommandAck& out) noexcept;
void fill(const SpacecraftStatus& status, omma_Status& out) noexcept;
/// @param out  `values` holds room for limits::kParameterIds
void fill(const ParameterSet& set, std::span<const ParameterEntry> entries, omma_Parameters& out) noexcept;

}  // namespace omma::telemetry
