#include "tests/bench/flown_sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kMargin = 3;  // [px] from the image's edge
constexpr double kElectronsPerLevel = 4;
constexpr double kFullWell = 9000;
const Eigen::Vector2d kPlate(0.254, 0.203);  // of the card [m]

}  // namespace

FlownSky::FlownSky(const Rig& rig, std::span<const SkyStar> stars, const SolarSystem& places,
                   const TargetBody& card, const FlownSkyOptions& options)
    : rig_(rig), stars_(stars), places_(places), card_(card), options_(options), random_(options.seed) {
  for (int i = 0; i < options.objects; ++i) {
    const double x = gauss(), y = gauss(), z = gauss();
    const Eigen::Vector3d start = Eigen::Vector3d(x, y, z).normalized();
    const double turn = uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector3d axis = rotation_exp(turn * start) * start.unitOrthogonal();
    runners_.push_back({start, axis, uniform(0.05, 1.0) * kDegree, uniform(0.5, 3.5)});
  }
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    for (int i = 0; i < options.hot_pixels; ++i)
      hot_pixels_[c].emplace_back(uniform(5, rig.cameras[c].lens.width() - 5.0),
                                  uniform(5, rig.cameras[c].lens.height() - 5.0));
  }
}

// The card sweeps before the first camera to and fro, once in a hundred seconds, at 0.8 to 2 m.
Pose FlownSky::rig_from_card() const {
  const double phase = 2 * std::numbers::pi * time_ / 100;
  const double range = 1.4 + 0.6 * std::cos(0.7 * phase);
  const double aside = 0.5 * std::sin(phase);
  const double up = 0.3 * std::sin(1.3 * phase);
  const Pose& camera = rig_.cameras[0].rig_from_camera;
  const Eigen::Vector3d sight = Eigen::Vector3d(std::sin(aside), std::sin(up), 1).normalized();
  Pose in_camera;
  in_camera.rotation = rotation_exp({0.3 * std::sin(phase), 0.3 * std::cos(0.8 * phase), 0.5 * phase}) *
                       rotation_exp({std::numbers::pi, 0, 0});
  in_camera.translation = range * sight;
  return camera * in_camera;
}

void FlownSky::turn(double seconds) {
  constexpr int kSteps = 20;
  const Eigen::Vector3d axis = options_.rate.norm() > 0 ? options_.rate : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d tilt = axis.unitOrthogonal() * options_.nutation_angle;
  for (int i = 0; i < kSteps; ++i) {
    const double t = time_ + seconds * (i + 0.5) / kSteps;
    const Eigen::Quaterniond about = rotation_exp(options_.nutation_rate * t * axis.normalized());
    rate_ = rotation_exp(about * tilt) * options_.rate;
    attitude_ = (rotation_exp(-seconds / kSteps * rate_) * attitude_).normalized();
  }
  time_ += seconds;
}

bool FlownSky::behind_card(std::size_t camera, const Eigen::Vector3d& in_rig) const {
  if (!options_.card) return false;
  const Pose card_from_rig = rig_from_card().inverse();
  const Eigen::Vector3d eye = card_from_rig * rig_.cameras[camera].rig_from_camera.translation;
  const Eigen::Vector3d ray = card_from_rig.rotation * in_rig;
  const double reach = -eye.z() / ray.z();
  if (!(reach > 0)) return false;
  const Eigen::Vector2d at = (eye + reach * ray).head<2>();
  return std::abs(at.x()) < kPlate.x() / 2 && std::abs(at.y()) < kPlate.y() / 2;
}

// Signal-to-noise ratio of a point of so many electrons over the sky and read noise of its pixels.
double FlownSky::snr_of(double electrons) const {
  const double pixels = 4 * std::numbers::pi * budget_.psf_sigma * budget_.psf_sigma;
  const double background = budget_.sky * options_.exposure + budget_.read_noise * budget_.read_noise;
  return electrons / std::sqrt(electrons + pixels * background);
}

// @param turning  change of the direction a second, rig frame [1/s]
bool FlownSky::add(std::size_t c, const Eigen::Vector3d& in_rig, double magnitude,
                   const Eigen::Vector3d& turning, LightName name) {
  const RigCamera& camera = rig_.cameras[c];
  const Eigen::Quaterniond camera_from_rig = camera.rig_from_camera.rotation.conjugate();
  Source source;
  Eigen::Matrix<double, 2, 3> by_direction;
  if (!camera.lens.project(camera_from_rig * in_rig, source.pixel, by_direction)) return false;
  if (source.pixel.x() < kMargin || source.pixel.y() < kMargin ||
      source.pixel.x() > camera.lens.width() - 1 - kMargin ||
      source.pixel.y() > camera.lens.height() - 1 - kMargin)
    return false;
  if (name.kind != Light::kTarget && behind_card(c, in_rig)) return false;
  const Eigen::Vector2d smear = options_.exposure * (by_direction * (camera_from_rig * turning));
  const double length = smear.norm();
  const double spread = 2 * std::sqrt(std::numbers::pi) * budget_.psf_sigma;  // of a point, as a length [px]
  const double share = spread / (spread + length);
  source.electrons = budget_.zero_point * options_.exposure * std::pow(10, -0.4 * magnitude);
  const double within = source.electrons * share;  // what a search for points sees of a trail
  const double snr = snr_of(within);
  if (snr < budget_.least_snr) return false;
  source.along = length > 1e-9 ? Eigen::Vector2d(smear / length) : Eigen::Vector2d::UnitX();
  source.sigma_across = std::max(0.02, budget_.psf_sigma / snr);
  source.sigma_along =
      std::max(0.02, std::sqrt(budget_.psf_sigma * budget_.psf_sigma + length * length / 12) / snr);
  source.saturated = within > 4 * kFullWell;
  source.name = name;
  sources_.push_back(source);
  return true;
}

void FlownSky::add_card(std::size_t c) {
  const Pose card = rig_from_card();
  const Eigen::Vector3d eye = rig_.cameras[c].rig_from_camera.translation;
  if ((card.inverse() * eye).z() <= 0) return;  // from behind
  for (std::size_t i = 0; i < card_.targets.size(); ++i)
    add(c, (card * card_.targets[i].position - eye).normalized(), 0.5, Eigen::Vector3d::Zero(),
        {Light::kTarget, static_cast<std::uint16_t>(i)});
}

// Lights that touch are one dot, in the middle of their light; noise comes last.
void FlownSky::gather(std::size_t c, DotList& list) {
  std::stable_sort(sources_.begin(), sources_.end(),
                   [](const Source& a, const Source& b) { return a.electrons > b.electrons; });
  const double touch = 4 * budget_.psf_sigma;
  std::vector<std::uint8_t> taken(sources_.size(), 0);
  struct Made {
    Dot dot;
    std::vector<LightName> names;
  };
  std::vector<Made> made;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (taken[i] != 0) continue;
    const Source& first = sources_[i];
    Made dot;
    double light = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (std::size_t k = i; k < sources_.size(); ++k) {
      if (taken[k] != 0 || (sources_[k].pixel - first.pixel).norm() > touch + first.extent) continue;
      taken[k] = 1;
      light += sources_[k].electrons;
      centre += sources_[k].electrons * sources_[k].pixel;
      dot.names.push_back(sources_[k].name);
    }
    const Eigen::Vector2d across(-first.along.y(), first.along.x());
    const double a = gauss(), b = gauss();
    dot.dot.pixel = centre / light + a * first.sigma_along * first.along + b * first.sigma_across * across;
    dot.dot.covariance = first.sigma_along * first.sigma_along * first.along * first.along.transpose() +
                         first.sigma_across * first.sigma_across * across * across.transpose();
    dot.dot.flux = static_cast<float>(light / kElectronsPerLevel);
    dot.dot.snr = static_cast<float>(budget_.psf_sigma / first.sigma_across);
    dot.dot.flags = first.saturated ? kDotSaturated : 0;
    made.push_back(std::move(dot));
  }
  std::stable_sort(made.begin(), made.end(),
                   [](const Made& a, const Made& b) { return a.dot.flux > b.dot.flux; });
  names_[c].clear();
  for (const Made& dot : made) {
    if (!list.dots.push_back(dot.dot)) break;
    names_[c].push_back(dot.names);
  }
}

void FlownSky::next(DotLists& lists) {
  if (frame_ > 0)
    turn(1 / options_.frame_rate);
  else
    turn(0);
  ++frame_;
  stars_seen_ = 0;
  lists.frame = frame_;
  lists.time_ns = 1 + static_cast<TimeNs>(std::llround(1e9 * time_));
  lists.cameras.resize(rig_.cameras.size());
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    DotList& list = lists.cameras[c];
    list = {};
    list.status = FrameStatus::kFresh;
    sources_.clear();
    const auto still = [&](const Eigen::Vector3d& in_rig) { return Eigen::Vector3d(-rate_.cross(in_rig)); };
    for (const SkyStar& star : stars_) {  // brightest first
      const double light = budget_.zero_point * options_.exposure * std::pow(10, -0.4 * star.magnitude);
      if (snr_of(light) < budget_.least_snr) break;
      const Eigen::Vector3d in_rig = attitude_ * star.direction;
      stars_seen_ += add(c, in_rig, star.magnitude, still(in_rig), {Light::kStar, star.hr}) ? 1 : 0;
    }
    for (const SolarBodyPlace& place : places_) {
      const Eigen::Vector3d in_rig = attitude_ * place.direction;
      if (options_.planets && place.body != SolarBody::kSun &&
          add(c, in_rig, place.magnitude, still(in_rig),
              {Light::kSolar, static_cast<std::uint16_t>(place.body)}))
        sources_.back().extent = place.radius / rig_.cameras[c].lens.pixel_angle();
    }
    for (std::size_t i = 0; i < runners_.size(); ++i) {
      const Runner& runner = runners_[i];
      const Eigen::Vector3d at = rotation_exp(time_ * runner.rate * runner.axis) * runner.start;
      const Eigen::Vector3d in_rig = attitude_ * at;
      add(c, in_rig, runner.magnitude, still(in_rig) + attitude_ * (runner.rate * runner.axis.cross(at)),
          {Light::kObject, static_cast<std::uint16_t>(i)});
    }
    if (options_.card) add_card(c);
    for (const Eigen::Vector2d& pixel : hot_pixels_[c])
      sources_.push_back({pixel, 600, 0.1, 0.1, Eigen::Vector2d::UnitX(), {}});
    for (int i = 0; i < options_.false_dots; ++i) {
      const double u = uniform(5, rig_.cameras[c].lens.width() - 5.0);
      const double v = uniform(5, rig_.cameras[c].lens.height() - 5.0);
      sources_.push_back({{u, v}, 400, 0.12, 0.12, Eigen::Vector2d::UnitX(), {}});
    }
    gather(c, list);
  }
}

}  // namespace omma
