#include "sim/gimbal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "components/geometry/pose.hpp"

namespace omma::sim {

SwingingMass::SwingingMass(double frequency, double damping, double foot)
    : frequency_(2 * std::numbers::pi * frequency), damping_(damping), foot_(foot), place_(foot) {}

// Against a foot in uniform motion the mass swings freely: e = z − y obeys e'' + 2 d w e' + w² e = 0, whose
// solution is exact for any step.
double SwingingMass::move(double foot, double step) {
  const double foot_speed = (foot - foot_) / step;
  const double decay = damping_ * frequency_;
  const double swing = frequency_ * std::sqrt(std::max(1e-12, 1 - damping_ * damping_));
  const double apart = place_ - foot_;
  const double speed = speed_ - foot_speed;
  const double cosine = std::cos(swing * step);
  const double sine = std::sin(swing * step);
  const double fall = std::exp(-decay * step);
  const double b = (speed + decay * apart) / swing;
  place_ = foot + fall * (apart * cosine + b * sine);
  speed_ = foot_speed + fall * ((b * swing - decay * apart) * cosine - (apart * swing + decay * b) * sine);
  foot_ = foot;
  return place_;
}

GimbalRun::GimbalRun(std::vector<GimbalPart> parts, double duration) : parts_(std::move(parts)) {
  const auto count = static_cast<std::size_t>(std::ceil(std::max(0.0, duration) / kBeat)) + 2;
  beats_.resize(count);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const GimbalPart& part = parts_[p];
    const PulseCalibration& pulses = part.motion.axis.pulses;
    const auto commanded = [&](std::size_t k) {
      return part.motion.trajectory.at(static_cast<double>(k) * kBeat).angle;
    };
    // The servo stands at the angle of its last pulse, which comes in steps.
    const auto driven = [&](std::size_t k) { return pulses.angle(pulses.pulse(commanded(k))); };
    Lash gear(part.flaws.lash, driven(0));
    Lash bearing(part.flaws.play, driven(0));
    SwingingMass structure(std::max(part.flaws.frequency, 1e-3), part.flaws.damping, driven(0));
    for (std::size_t k = 0; k < count; ++k) {
      GimbalAngles& beat = beats_[k];
      beat.commanded[p] = commanded(k);
      const double geared = gear.follow(driven(k));
      beat.real[p] = part.flaws.frequency > 0 ? structure.move(geared, kBeat) : geared;
      beat.tilt[p] = geared - bearing.follow(geared);
    }
  }
}

GimbalAngles GimbalRun::at(double time) const {
  const double last = static_cast<double>(beats_.size() - 1);
  const double place = std::clamp(time / kBeat, 0.0, last);
  const auto before = static_cast<std::size_t>(std::min(place, last - 1));
  const double part = place - static_cast<double>(before);
  GimbalAngles angles;
  const auto between = [&](std::array<double, 3> GimbalAngles::*member, std::size_t p) {
    const double a = (beats_[before].*member)[p];
    return a + part * ((beats_[before + 1].*member)[p] - a);
  };
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    angles.commanded[p] = between(&GimbalAngles::commanded, p);
    angles.real[p] = between(&GimbalAngles::real, p);
    angles.tilt[p] = between(&GimbalAngles::tilt, p);
  }
  return angles;
}

// Each axis carries the next; a bearing tilts about the axis after its own.
Eigen::Quaterniond GimbalRun::turn(const GimbalAngles& angles) const {
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const int axis = parts_[p].turns_about;
    turn = turn * rotation_exp(angles.real[p] * Eigen::Vector3d::Unit(axis)) *
           rotation_exp(angles.tilt[p] * Eigen::Vector3d::Unit((axis + 1) % 3));
  }
  return turn.normalized();
}

}  // namespace omma::sim
