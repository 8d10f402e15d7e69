#include "tests/bench/sky_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/random_direction.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kWidth = 1024;
constexpr int kHeight = 768;

Eigen::Quaterniond random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  Eigen::Vector4d q;
  for (double& c : q) c = gauss(random);
  q.normalize();
  return {q(3), q(0), q(1), q(2)};
}

/// Camera looking along `axis` with `up` at the top of its image.
Eigen::Quaterniond rig_from_camera(const Eigen::Vector3d& axis, const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = axis.normalized();
  const Eigen::Vector3d y = -(up - z * z.dot(up)).normalized();
  Eigen::Matrix3d r;
  r << y.cross(z), y, z;
  return Eigen::Quaterniond(r);
}

class DotMaker {
 public:
  DotMaker(const Rig& rig, const SkyProblemOptions& options, std::mt19937_64& random, SkyProblem& problem)
      : rig_(rig), options_(options), random_(random), problem_(problem) {}

  /// Adds what camera `c` makes of the rig-frame direction; false when it does not see it.
  bool add(std::size_t c, const Eigen::Vector3d& direction, double magnitude, std::uint16_t hr) {
    const RigCamera& camera = rig_.cameras[c];
    Dot dot;
    if (!camera.lens.project(camera.rig_from_camera.rotation.conjugate() * direction, dot.pixel))
      return false;
    if (dot.pixel.x() < 3 || dot.pixel.y() < 3 || dot.pixel.x() > kWidth - 4 || dot.pixel.y() > kHeight - 4)
      return false;
    const Eigen::Vector2d from_centre = dot.pixel - Eigen::Vector2d(kWidth / 2.0, kHeight / 2.0);
    const double edge = from_centre.norm() / (kWidth / 2.0);
    dot.pixel += options_.lens_error_px * edge * edge * edge * from_centre.normalized();
    const double a = gauss_(random_);
    const double b = gauss_(random_);
    dot.pixel += options_.noise_px * Eigen::Vector2d(a, b);
    dot.covariance = options_.noise_px * options_.noise_px * Eigen::Matrix2d::Identity();
    dot.flux = static_cast<float>(
        1e4 * std::pow(10, -0.4 * (magnitude + options_.magnitude_scatter * gauss_(random_))));
    RigDot out;
    if (!rig_dot(dot, static_cast<std::uint16_t>(problem_.dots.size()), camera, static_cast<std::uint8_t>(c),
                 0, out))
      return false;
    problem_.dots.push_back(out);
    problem_.hr.push_back(hr);
    return true;
  }

  /// A false dot of camera `c`, anywhere in the image it has a ray for, as bright as a random star.
  void add_false(std::size_t c, double magnitude) {
    std::uniform_real_distribution<double> u(4, kWidth - 5);
    std::uniform_real_distribution<double> v(4, kHeight - 5);
    const RigCamera& camera = rig_.cameras[c];
    for (int attempt = 0; attempt < 50; ++attempt) {
      Eigen::Vector3d ray;
      const double x = u(random_);
      const double y = v(random_);
      if (camera.lens.bearing({x, y}, ray) && add(c, camera.rig_from_camera.rotation * ray, magnitude, 0))
        return;
    }
  }

 private:
  const Rig& rig_;
  const SkyProblemOptions& options_;
  std::mt19937_64& random_;
  SkyProblem& problem_;
  std::normal_distribution<double> gauss_;
};

}  // namespace

Rig equidistant_rig(int cameras, double horizontal_deg) {
  const Eigen::Vector3d axes[] = {{0, 0, 1},
                                  {std::sqrt(8.0 / 9), 0, -1.0 / 3},
                                  {-std::sqrt(2.0 / 9), std::sqrt(2.0 / 3), -1.0 / 3},
                                  {-std::sqrt(2.0 / 9), -std::sqrt(2.0 / 3), -1.0 / 3}};
  Rig rig;
  const double f = kWidth / 2.0 / (0.5 * horizontal_deg * kDegree);
  for (int c = 0; c < cameras; ++c) {
    RigCamera camera;
    camera.lens =
        Lens::equidistant(kWidth, kHeight, f, {kWidth / 2.0 - 0.5, kHeight / 2.0 - 0.5}, 95 * kDegree);
    camera.rig_from_camera.rotation =
        rig_from_camera(axes[c], c == 0 ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 0, 1));
    rig.cameras.push_back(camera);
  }
  return rig;
}

Rig pinhole_rig(double horizontal_deg) {
  Rig rig;
  RigCamera camera;
  camera.lens = Lens::pinhole(kWidth, kHeight, horizontal_deg * kDegree);
  rig.cameras.push_back(camera);
  return rig;
}

SkyProblem random_sky(const Rig& rig, std::span<const SkyStar> stars, const SkyProblemOptions& options,
                      std::mt19937_64& random) {
  SkyProblem problem;
  problem.truth = random_rotation(random);
  DotMaker maker(rig, options, random, problem);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<float> magnitudes;
  std::size_t bright = 0;
  while (bright < stars.size() && stars[bright].magnitude < options.magnitude_limit) ++bright;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const std::size_t before = problem.dots.size();
    for (const SkyStar& star : stars.first(bright)) {
      if (unit(random) < options.missing_fraction) continue;
      if (options.stars_per_camera > 0 &&
          problem.dots.size() - before >= std::size_t(options.stars_per_camera))
        break;
      maker.add(c, problem.truth * star.direction, star.magnitude, star.hr);
    }
    const std::size_t seen = problem.dots.size() - before;
    const auto wanted = static_cast<std::size_t>(
        std::lround(double(seen) * options.false_fraction / (1 - options.false_fraction)));
    for (std::size_t n = 0; n < wanted; ++n) maker.add_false(c, stars[random() % bright].magnitude);
    for (int n = 0; n < options.false_dots; ++n) maker.add_false(c, stars[random() % bright].magnitude);
    for (int n = 0; n < options.bright_false; ++n) maker.add_false(c, -5);
  }
  for (int n = 0; n < options.false_on_sphere; ++n) {
    const Eigen::Vector3d direction = random_direction(random);
    const float magnitude = stars[random() % bright].magnitude;
    for (std::size_t c = 0; c < rig.cameras.size(); ++c) maker.add(c, direction, magnitude, 0);
  }
  return problem;
}

SkyVerdict judge(const SkyProblem& problem, const Identification& answer) {
  if (answer.status != IdentificationStatus::kIdentified) {
    return answer.status == IdentificationStatus::kMirrored ? SkyVerdict::kWrong : SkyVerdict::kUnsolved;
  }
  if (answer.rig_from_j2000.angularDistance(problem.truth) > 0.1 * kDegree) return SkyVerdict::kWrong;
  std::size_t mistaken = 0;
  for (const StarMatch& m : answer.matches) mistaken += problem.hr[m.dot] != m.hr ? 1 : 0;
  return 10 * mistaken > answer.matches.size() ? SkyVerdict::kWrong : SkyVerdict::kRight;
}

}  // namespace omma
