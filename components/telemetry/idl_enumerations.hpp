// The enumerations of the IDL follow the components' own, value by value: checked here, so that copying is a
// cast.
#pragma once

#include "components/telemetry/samples.hpp"

namespace omma::telemetry {

template <class To, class From>
To same(From value) noexcept {
  return static_cast<To>(value);
}

/// Where the IDL has one value more in front.
template <class To, class From>
To after_first(From value) noexcept {
  return static_cast<To>(static_cast<int>(value) + 1);
}

static_assert(omma_EXPOSURE_GOOD == static_cast<int>(ExposureState::kGood) + 1);
static_assert(omma_EXPOSURE_WAITING == static_cast<int>(ExposureState::kWaiting) + 1);
static_assert(omma_EXPOSURE_AT_LIMIT == static_cast<int>(ExposureState::kAtLimit) + 1);
static_assert(omma_EXPOSURE_BRACKET == static_cast<int>(ExposureState::kBracket) + 1);
static_assert(omma_FRAME_MISSING == static_cast<int>(FrameStatus::kMissing));
static_assert(omma_FRAME_FRESH == static_cast<int>(FrameStatus::kFresh));
static_assert(omma_FRAME_LATE == static_cast<int>(FrameStatus::kLate));
static_assert(omma_FRAME_STUCK == static_cast<int>(FrameStatus::kStuck));
static_assert(omma_FRAME_SATURATED == static_cast<int>(FrameStatus::kSaturated));
static_assert(omma_FRAME_MISMATCHED == static_cast<int>(FrameStatus::kMismatched));
static_assert(omma_UTC_NONE == static_cast<int>(UtcSource::kNone));
static_assert(omma_UTC_MISSION_EPOCH == static_cast<int>(UtcSource::kMissionEpoch));
static_assert(omma_UTC_SYSTEM_CLOCK == static_cast<int>(UtcSource::kSystemClock));
static_assert(omma_UTC_DISCIPLINED_CLOCK == static_cast<int>(UtcSource::kDisciplinedClock));
static_assert(omma_TRACK_LOST == static_cast<int>(TrackState::kLost));
static_assert(omma_TRACK_ACQUIRED == static_cast<int>(TrackState::kAcquired));
static_assert(omma_TRACK_TRACKING == static_cast<int>(TrackState::kTracking));
static_assert(omma_SOLVE_NONE == static_cast<int>(SolveStatus::kNone));
static_assert(omma_SOLVE_SOLVED == static_cast<int>(SolveStatus::kSolved));
static_assert(omma_SOLVE_ITERATION_CAP == static_cast<int>(SolveStatus::kIterationCap));
static_assert(omma_SOLVE_TOO_FEW_PAIRS == static_cast<int>(SolveStatus::kTooFewPairs));
static_assert(omma_SOLVE_UNOBSERVABLE == static_cast<int>(SolveStatus::kUnobservable));
static_assert(omma_SOLVE_INCONSISTENT == static_cast<int>(SolveStatus::kInconsistent));
static_assert(omma_HEALTH_OK == static_cast<int>(HealthState::kOk));
static_assert(omma_HEALTH_DEGRADED == static_cast<int>(HealthState::kDegraded));
static_assert(omma_HEALTH_FAILED == static_cast<int>(HealthState::kFailed));
static_assert(omma_RANGE_NONE == static_cast<int>(RangeMode::kNone));
static_assert(omma_RANGE_FAR == static_cast<int>(RangeMode::kFar));
static_assert(omma_RANGE_INTERMEDIATE == static_cast<int>(RangeMode::kIntermediate));
static_assert(omma_RANGE_CLOSE == static_cast<int>(RangeMode::kClose));
static_assert(omma_MOTION_UNDECIDED == static_cast<int>(ObjectMotion::kUndecided));
static_assert(omma_MOTION_MOVING == static_cast<int>(ObjectMotion::kMoving));
static_assert(omma_MOTION_WITH_THE_STARS == static_cast<int>(ObjectMotion::kWithTheStars));
static_assert(omma_MOTION_WITH_THE_RIG == static_cast<int>(ObjectMotion::kWithTheRig));
static_assert(omma_IMAGE_PANORAMA_J2000 == static_cast<int>(ImageKind::kPanoramaJ2000));
static_assert(omma_INTEGRITY_ALERT == static_cast<int>(IntegrityState::kAlert));
static_assert(omma_IMAGE_PANORAMA_RIG == static_cast<int>(ImageKind::kPanoramaRig));
static_assert(omma_IMAGE_VIEW == static_cast<int>(ImageKind::kView));
static_assert(omma_IMAGE_FISHEYE_J2000 == static_cast<int>(ImageKind::kFisheyeJ2000));
static_assert(omma_IMAGE_FISHEYE_RIG == static_cast<int>(ImageKind::kFisheyeRig));
static_assert(omma_IMAGE_CAMERA == static_cast<int>(ImageKind::kCamera));
static_assert(omma_IMAGE_VIEW_RIG == static_cast<int>(ImageKind::kViewRig));
static_assert(omma_COMPOSITE_MEAN == static_cast<int>(ImageComposite::kMean));
static_assert(omma_COMPOSITE_DARKEST == static_cast<int>(ImageComposite::kDarkest));
static_assert(omma_COMPOSITE_BRIGHTEST == static_cast<int>(ImageComposite::kBrightest));
static_assert(omma_COMPOSITE_FUSED == static_cast<int>(ImageComposite::kFused));
static_assert(omma_SCALE_SQUARE_ROOT == static_cast<int>(ImageScale::kSquareRoot));
static_assert(omma_SCALE_LINEAR == static_cast<int>(ImageScale::kLinear));
static_assert(omma_SCALE_ASINH == static_cast<int>(ImageScale::kAsinh));
static_assert(omma_ENCODING_PREDICTED_ZSTD == static_cast<int>(ImageEncoding::kPredictedZstd));
static_assert(omma_MOTION_APPROACHING == static_cast<int>(MotionMode::kApproaching));
static_assert(omma_MOTION_RUNNING == static_cast<int>(MotionMode::kRunning));
static_assert(omma_MOTION_FINISHED == static_cast<int>(MotionMode::kFinished));
static_assert(omma_MOTION_HOMING == static_cast<int>(MotionMode::kHoming));
static_assert(omma_MOTION_HOME == static_cast<int>(MotionMode::kHome));
static_assert(omma_MOTION_STOPPED == static_cast<int>(MotionMode::kStopped));
static_assert(omma_MODE_STANDBY == static_cast<int>(Mode::kStandby));
static_assert(omma_MODE_ACQUIRE == static_cast<int>(Mode::kAcquire));
static_assert(omma_MODE_TRACK == static_cast<int>(Mode::kTrack));
static_assert(omma_MODE_SAFE == static_cast<int>(Mode::kSafe));
static_assert(omma_COMMAND_ACCEPTED == static_cast<int>(CommandStage::kAccepted));
static_assert(omma_COMMAND_REJECTED == static_cast<int>(CommandStage::kRejected));
static_assert(omma_COMMAND_COMPLETED == static_cast<int>(CommandStage::kCompleted));
static_assert(omma_COMMAND_FAILED == static_cast<int>(CommandStage::kFailed));
static_assert(omma_REASON_NONE == static_cast<int>(CommandReason::kNone));
static_assert(omma_REASON_SESSION == static_cast<int>(CommandReason::kSession));
static_assert(omma_REASON_SEQUENCE_REPEATED == static_cast<int>(CommandReason::kSequenceRepeated));
static_assert(omma_REASON_SEQUENCE_AHEAD == static_cast<int>(CommandReason::kSequenceAhead));
static_assert(omma_REASON_OPCODE == static_cast<int>(CommandReason::kOpcode));
static_assert(omma_REASON_ARGUMENT_COUNT == static_cast<int>(CommandReason::kArgumentCount));
static_assert(omma_REASON_ARGUMENT_TYPE == static_cast<int>(CommandReason::kArgumentType));
static_assert(omma_REASON_ARGUMENT_RANGE == static_cast<int>(CommandReason::kArgumentRange));
static_assert(omma_REASON_MODE == static_cast<int>(CommandReason::kMode));
static_assert(omma_REASON_BUSY == static_cast<int>(CommandReason::kBusy));
static_assert(omma_REASON_REFUSED == static_cast<int>(CommandReason::kRefused));
static_assert(omma_REASON_NOT_SAVED == static_cast<int>(CommandReason::kNotSaved));

}  // namespace omma::telemetry
