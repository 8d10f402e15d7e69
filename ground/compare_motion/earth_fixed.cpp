#include "ground/compare_motion/earth_fixed.hpp"

#include <cmath>

#include "components/geometry/pose.hpp"

namespace omma::ground {

Eigen::Vector3d earth_fixed_rate(const Eigen::Quaterniond& rig_from_j2000) {
  return rig_from_j2000 * (kEarthRate * Eigen::Vector3d::UnitZ());
}

StationaryRig stationary_rig(const std::vector<TimedAttitude>& attitudes) {
  StationaryRig rig;
  // A rig fixed to the Earth: j2000_from_rig(t) = turn(ω t about the pole) · j2000_from_rig(0).
  std::vector<Eigen::Quaterniond> at_start;
  at_start.reserve(attitudes.size());
  for (const TimedAttitude& a : attitudes)
    at_start.push_back(a.rig_from_j2000 * rotation_exp({0, 0, kEarthRate * a.time}));
  rig.rig_from_j2000 = at_start.front();
  for (int pass = 0; pass < 5; ++pass) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Quaterniond& q : at_start) sum += rotation_log(rig.rig_from_j2000.conjugate() * q);
    rig.rig_from_j2000 = (rig.rig_from_j2000 * rotation_exp(sum / double(at_start.size()))).normalized();
  }
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double mean_time = 0;
  for (const TimedAttitude& a : attitudes) mean_time += a.time / double(attitudes.size());
  double time_squares = 0;
  double time_turn = 0;
  for (std::size_t i = 0; i < at_start.size(); ++i) {
    const Eigen::Vector3d deviation = rotation_log(rig.rig_from_j2000.conjugate() * at_start[i]);
    rig.deviations.push_back(deviation);
    squares += deviation.cwiseAbs2();
    const double t = attitudes[i].time - mean_time;
    time_squares += t * t;
    time_turn += t * deviation.z();
  }
  rig.rms = (squares / double(at_start.size())).cwiseSqrt();
  // Attitude rig_from_j2000 · turn(ω₀ t): a faster Earth leaves a deviation of (ω₀ − ω) t.
  const double slope = time_squares > 0 ? time_turn / time_squares : 0;
  rig.measured_rate = kEarthRate - slope;
  double scatter = 0;
  for (std::size_t i = 0; i < at_start.size(); ++i) {
    const double rest = rig.deviations[i].z() - slope * (attitudes[i].time - mean_time);
    scatter += rest * rest;
  }
  if (at_start.size() > 2 && time_squares > 0)
    rig.measured_rate_sigma = std::sqrt(scatter / double(at_start.size() - 2) / time_squares);
  return rig;
}

}  // namespace omma::ground
