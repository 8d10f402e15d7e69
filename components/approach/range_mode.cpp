#include "components/approach/range_mode.hpp"

#include <algorithm>

namespace omma {
namespace {

// One of the two runs goes on, the other ends.
void count(bool there, int& with, int& without) noexcept {
  constexpr int kLong = 1'000'000;
  with = there ? std::min(with + 1, kLong) : 0;
  without = there ? 0 : std::min(without + 1, kLong);
}

}  // namespace

// A light that is not seen in this frame set says nothing against its range of the one before.
bool RangeModes::brightness_serves(const RangeEvidence& evidence) const noexcept {
  const bool told = mode_ == RangeMode::kIntermediate;
  const double least_snr = told ? parameters_.snr_leave : parameters_.snr_enter;
  const double most_sigma = told ? parameters_.range_sigma_leave : parameters_.range_sigma_enter;
  const bool bright = evidence.snr >= least_snr || (told && evidence.snr <= 0);
  return evidence.followed && bright && evidence.range_sigma <= most_sigma;
}

RangeMode RangeModes::step(const RangeEvidence& evidence) noexcept {
  count(evidence.pose, with_pose_, without_pose_);
  count(brightness_serves(evidence), with_range_, without_range_);
  if (with_pose_ >= parameters_.settle) return mode_ = RangeMode::kClose;
  if (mode_ == RangeMode::kClose && without_pose_ < parameters_.patience) return mode_;
  if (!evidence.followed) return mode_ = RangeMode::kNone;
  if (mode_ == RangeMode::kNone) mode_ = RangeMode::kFar;
  // What fiducials said of range and brightness is remembered: out of the close mode no settling is asked
  // for.
  const int settle = mode_ == RangeMode::kClose ? 1 : parameters_.settle;
  if (with_range_ >= settle) return mode_ = RangeMode::kIntermediate;
  if (mode_ == RangeMode::kClose || without_range_ >= parameters_.patience) mode_ = RangeMode::kFar;
  return mode_;
}

}  // namespace omma
