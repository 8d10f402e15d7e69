#include "components/approach/light_doubt.hpp"

#include <algorithm>

namespace omma {
namespace {

constexpr double kTurned = 20;  // σ of the light that the sky has to turn before its place in the rig tells
constexpr double kStayed = 0.25;   // of that turn: what stands with the rig moved less there
constexpr double kBrighter = 1.2;  // times the flux: noise is left out
constexpr int kTimes = 20;         // frame sets in which another outshone it, over those in which it did not

}  // namespace

void LightDoubt::start(const Eigen::Vector3d& direction, const Eigen::Matrix3d& rig_from_j2000) noexcept {
  in_sky_ = direction;
  in_rig_ = rig_from_j2000 * direction;
  other_ = 0;
  times_ = 0;
}

// Chords for angles: where they differ the answer is beyond doubt.
bool LightDoubt::stands_with_rig(const Eigen::Vector3d& direction, double sigma,
                                 const Eigen::Matrix3d& rig_from_j2000) const noexcept {
  const double turned = (rig_from_j2000.transpose() * in_rig_ - in_sky_).norm();
  const double moved = (rig_from_j2000 * direction - in_rig_).norm();
  return turned > kTurned * sigma && moved < kStayed * turned;
}

bool LightDoubt::outshone(std::uint32_t other, double other_flux, double flux) noexcept {
  if (other != 0 && other_flux > kBrighter * flux) {
    times_ = other == other_ ? times_ + 1 : 1;
    other_ = other;
  } else {
    times_ = std::max(0, times_ - 1);
  }
  return times_ >= kTimes;
}

}  // namespace omma
