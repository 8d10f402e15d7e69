#include "components/approach/body_light.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "components/geometry/pose.hpp"
#include "components/geometry/rig_dot.hpp"

namespace omma {
namespace {

constexpr double kGateSigmas = 4;

double square(double x) {
  return x * x;
}

// A part of the body's radius at its nearest plausible range; nothing where the range is not known.
double angular_radius(const ExpectedLight& expected) noexcept {
  if (expected.log_range_sigma > kRangeKnown) return 0;
  return std::min(expected.size.radius / expected.range * (1 + 2 * expected.log_range_sigma), 0.3);
}

struct Sum {
  double flux = 0;
  double variance = 0;    // of noise
  double unsure = 0;      // variance of the rest
  double background = 0;  // about its brightest dot
  double brightest = 0;
  Eigen::Vector3d ray = Eigen::Vector3d::Zero();  // rig, weighted with flux
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  bool whole = true;
};

// The camera is beside the rig's origin; seen from there the body stands a little elsewhere.
LightSighting sighting(const Sum& sum, const RigCamera& camera, const Eigen::Matrix3d& rig_from_j2000,
                       const ExpectedLight& expected) noexcept {
  LightSighting out;
  out.seen = true;
  out.whole = sum.whole;
  out.flux = sum.flux;
  out.flux_sigma = std::sqrt(sum.variance);
  out.unsure = std::sqrt(sum.unsure);
  out.background = sum.background;
  const Eigen::Vector3d ray = sum.ray.normalized();
  const Eigen::Vector3d origin = camera.rig_from_camera.translation;
  const Eigen::Vector3d axis = camera.rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  out.axis_angle = std::acos(std::clamp(axis.dot(ray), -1.0, 1.0));
  out.direction = rig_from_j2000.transpose() * (expected.range * ray + origin).normalized();
  const double parallax = origin.cross(ray).norm() / expected.range * std::min(expected.log_range_sigma, 1.0);
  out.covariance = sum.covariance / square(sum.flux) + square(parallax) * Eigen::Matrix3d::Identity();
  out.whitener = direction_whitener(out.direction, out.covariance);
  return out;
}

}  // namespace

void widen(LightSighting& sighting, const Eigen::Matrix3d& more) noexcept {
  sighting.covariance += more;
  sighting.whitener = direction_whitener(sighting.direction, sighting.covariance);
}

double centre_variance(const ExpectedLight& expected) noexcept {
  constexpr double kUnlike = 0.3;  // of the brightness of one light, as it is seen
  // Of the spread: where a dot's centre may be, of those that are bright together; and where they part.
  constexpr double kPart = 0.3;
  constexpr double kParted = 0.7;
  constexpr double kParting = 1.5;  // radius [px]; at twice that they have
  const double known = std::min(expected.log_range_sigma, 1.0);
  const BodySize& size = expected.size;
  const double apart = size.radius / expected.range / (kParting * expected.pixel) - 1;
  const double of_dot = kPart + (kParted - kPart) * std::clamp(apart, 0.0, 1.0);
  const double of_sum = kUnlike / std::sqrt(size.targets);
  const double part = (of_dot + expected.summed * (of_sum - of_dot)) * size.spread;
  // Mean of 1 / r² where ln r is known so well.
  return (square(size.centre) + square(part)) * std::exp(2 * known * known) / (3 * square(expected.range));
}

BodySize size_of(const TargetBody& body) {
  BodySize size;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Target& target : body.targets) {
    mean += target.position;
    size.radius = std::max(size.radius, target.position.norm());
  }
  size.targets = static_cast<double>(body.targets.size());
  mean /= size.targets;
  size.centre = mean.norm();
  double sum = 0;
  for (const Target& target : body.targets) sum += (target.position - mean).squaredNorm();
  size.spread = std::sqrt(sum / size.targets);
  return size;
}

void find_light(std::span<const LeftoverDot> dots, const DotLists& lists, const Rig& rig,
                const Eigen::Matrix3d& rig_from_j2000, const ExpectedLight& expected,
                LightSightings& out) noexcept {
  std::array<Sum, limits::kCameras> sums{};
  const double radius = angular_radius(expected);
  for (const LeftoverDot& dot : dots) {
    if (!(dot.flux > 0) || !(dot.snr > 0)) continue;
    const Eigen::Vector3d origin = rig.cameras[dot.camera].rig_from_camera.translation;
    const double parallax = origin.norm() / expected.range;
    const double reach = radius + parallax * std::min(2 * expected.log_range_sigma, 1.0) +
                         kGateSigmas * (expected.sigma + dot.sigma + std::sqrt(centre_variance(expected)));
    const Eigen::Vector3d from_origin =
        (dot.direction + rig_from_j2000.transpose() * origin / expected.range).normalized();
    if ((from_origin - expected.direction).squaredNorm() > square(reach)) continue;
    Sum& sum = sums[dot.camera];
    sum.flux += dot.flux;
    sum.variance += square(dot.flux / dot.snr);
    sum.ray += dot.flux * dot.ray;
    sum.covariance += square(dot.flux) * direction_covariance(dot);
    const Dot& seen = lists.cameras[dot.camera].dots[dot.dot];
    sum.whole = sum.whole && (seen.flags & kDotSaturated) == 0;
    if (double(dot.flux) <= sum.brightest) continue;
    sum.brightest = dot.flux;
    sum.background = seen.background;
  }
  for (std::size_t c = 0; c < out.size(); ++c) {
    out[c] = {};
    if (c < rig.cameras.size() && sums[c].flux > 0)
      out[c] = sighting(sums[c], rig.cameras[c], rig_from_j2000, expected);
  }
}

double aperture_radius(const ExpectedLight& expected, const RigCamera& camera) noexcept {
  constexpr double kSpot = 2.0;  // round the outermost light [px]
  constexpr double kPointLike =
      0.4;  // radius of the body [px]: a smaller one is one dot, better fitted as such
  const double pixel = camera.lens.pixel_angle();
  const double radius = angular_radius(expected) / pixel;
  if (radius < kPointLike) return 0;
  return radius + kSpot + (expected.sigma + std::sqrt(centre_variance(expected))) / pixel;
}

namespace {

// A star's light is known to a part, and near the circle's edge not how much of it is inside.
double take_away(const StarNearby& star, const RigCamera& camera, const Aperture& aperture,
                 const Eigen::Matrix3d& rig_from_j2000, Sum& sum) noexcept {
  constexpr double kEdge = 1.5;  // half width [px]
  const Eigen::Vector3d ray = rig_from_j2000 * star.direction;
  Eigen::Vector2d pixel;
  if (!camera.lens.project(camera.rig_from_camera.rotation.conjugate() * ray, pixel)) return 0;
  const double inside = aperture.radius - (pixel - aperture.centre).norm();
  if (inside < -kEdge - 0.5) return 0;
  const double share = std::clamp(0.5 + 0.5 * inside / kEdge, 0.0, 1.0);
  const double sigma = star.flux * (0.15 * share + 0.6 * share * (1 - share));
  const Eigen::Vector3d offset = ray - sum.ray.normalized();
  sum.covariance += square(sigma) * (rig_from_j2000.transpose() * offset) *
                    (rig_from_j2000.transpose() * offset).transpose();
  sum.flux -= share * star.flux;
  sum.unsure += square(sigma);
  sum.ray -= share * star.flux * ray;
  return star.flux;
}

}  // namespace

Looked look_at_light(const ImageView& image, const RigCamera& camera, std::uint8_t index,
                     const Aperture& told, std::span<const StarNearby> stars, double floor_px,
                     const Eigen::Matrix3d& rig_from_j2000, const ExpectedLight& expected,
                     LightSighting& out) noexcept {
  constexpr double kMostOfStars = 0.5;  // of the light in the circle
  Aperture aperture = told;
  aperture.radius = aperture_radius(expected, camera);
  const Eigen::Vector3d place = expected.range * (rig_from_j2000 * expected.direction);
  const Eigen::Vector3d in_camera = camera.rig_from_camera.inverse() * place;
  Dot dot;
  if (aperture.radius <= 0 || !camera.lens.project(in_camera.normalized(), aperture.centre))
    return Looked::kNothing;
  if (!measure_aperture(image, aperture, dot)) return Looked::kNothing;
  RigDot seen;
  if (!rig_dot(dot, 0, camera, index, floor_px, seen)) return Looked::kNothing;
  LeftoverDot in_sky;
  in_sky.whitener = seen.whitener * rig_from_j2000;
  Sum sum;
  sum.flux = dot.flux;
  sum.variance = square(dot.flux / dot.snr);
  sum.ray = dot.flux * seen.ray;
  sum.covariance = square(dot.flux) * direction_covariance(in_sky);
  sum.whole = (dot.flags & kDotSaturated) == 0;
  sum.background = dot.background;
  double of_stars = 0;
  for (const StarNearby& star : stars) of_stars += take_away(star, camera, aperture, rig_from_j2000, sum);
  if (of_stars > kMostOfStars * dot.flux) return Looked::kAmongStars;
  out = sighting(sum, camera, rig_from_j2000, expected);
  return Looked::kSeen;
}

Eigen::Matrix<double, 2, 3> direction_whitener(const Eigen::Vector3d& direction,
                                               const Eigen::Matrix3d& covariance) noexcept {
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(direction);
  const Eigen::Matrix2d across = basis.transpose() * covariance * basis;
  const Eigen::LLT<Eigen::Matrix2d> factor(across);
  Eigen::Matrix<double, 2, 3> whitener = basis.transpose();
  factor.matrixL().solveInPlace(whitener);
  return whitener;
}

}  // namespace omma
