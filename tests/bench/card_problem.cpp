#include "tests/bench/card_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWidth = 0.254, kHeight = 0.2032;  // 10 × 8 in
constexpr double kLeastSpacing = 0.12;              // of the card's height
constexpr int kSide = 768;
constexpr double kFocal = kSide / std::numbers::pi;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ULL + 7) {}
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double gauss() { return gauss_(random_); }
  Eigen::Vector3d direction() {
    const double x = gauss(), y = gauss(), z = gauss();
    return Eigen::Vector3d(x, y, z).normalized();
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    std::shuffle(items.begin(), items.end(), random_);
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> gauss_;
};

/// LEDs on the six faces of a cube as wide as the card.
TargetBody random_box(const CardProblemOptions& options, Draw& draw) {
  TargetBody body;
  for (int face = 0; face < 6; ++face) {
    const Eigen::Vector3d normal = (face % 2 == 0 ? 1 : -1) * Eigen::Vector3d::Unit(face / 2);
    const Eigen::Matrix<double, 3, 2> plane = tangent_basis(normal);
    for (int placed = 0; placed < options.targets;) {
      const double x = draw.uniform(-0.42, 0.42) * kWidth, y = draw.uniform(-0.42, 0.42) * kWidth;
      Target target;
      target.normal = normal;
      target.position = 0.5 * kWidth * normal + plane * Eigen::Vector2d(x, y);
      target.group = face;
      const bool free = std::all_of(body.targets.begin(), body.targets.end(), [&](const Target& other) {
        return (other.position - target.position).norm() > kLeastSpacing * kHeight;
      });
      if (!free) continue;
      body.targets.push_back(target);
      ++placed;
    }
  }
  return body;
}

TargetBody random_body(const CardProblemOptions& options, Draw& draw) {
  if (options.faces) return random_box(options, draw);
  TargetBody body;
  double spacing = kLeastSpacing * kHeight;
  for (int tries = 0; static_cast<int>(body.targets.size()) < options.targets; ++tries) {
    if (tries % 2000 == 1999) spacing *= 0.9;
    const double x = draw.uniform(-0.5, 0.5) * kWidth, y = draw.uniform(-0.5, 0.5) * kHeight;
    const double z = options.solid ? draw.uniform(-0.5, 0.5) * kWidth : 0;
    Target target;
    target.position = {x, y, z};
    const bool free = std::all_of(body.targets.begin(), body.targets.end(), [&](const Target& other) {
      return (other.position - target.position).norm() > spacing;
    });
    if (free) body.targets.push_back(target);
  }
  return body;
}

std::vector<RigCamera> cameras_of(const CardProblemOptions& options) {
  std::vector<RigCamera> cameras(static_cast<std::size_t>(options.cameras));
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    cameras[k].lens =
        Lens::equidistant(kSide, kSide, kFocal, {0.5 * (kSide - 1), 0.5 * (kSide - 1)}, 95 * kDegree);
    cameras[k].rig_from_camera.rotation =
        rotation_exp(Eigen::Vector3d(0, -40 * kDegree * static_cast<double>(k), 0));
    cameras[k].rig_from_camera.translation = {0.2 * static_cast<double>(k), 0, 0};
  }
  return cameras;
}

struct SeenPixel {
  Eigen::Vector2d pixel;
  int target;
};

/// Pixels of the visible targets with noise; their bounding circle comes out as `centre`, `radius`.
std::vector<SeenPixel> see_targets(const CardProblem& problem, const RigCamera& camera,
                                   const CardProblemOptions& options, Draw& draw, Eigen::Vector2d& centre,
                                   double& radius) {
  std::vector<SeenPixel> seen;
  const Pose camera_from_body = camera.rig_from_camera.inverse() * problem.truth;
  for (std::size_t t = 0; t < problem.body.targets.size(); ++t) {
    if (!faces(problem.body.targets[t], camera_from_body.inverse().translation)) continue;
    Eigen::Vector2d pixel;
    const Eigen::Vector3d d = camera_from_body * problem.body.targets[t].position;
    if (camera.lens.project(d.normalized(), pixel)) seen.push_back({pixel, static_cast<int>(t)});
  }
  centre.setZero();
  for (const SeenPixel& s : seen)
    centre += s.pixel / static_cast<double>(std::max<std::size_t>(1, seen.size()));
  radius = 1;
  for (const SeenPixel& s : seen) radius = std::max(radius, (s.pixel - centre).norm());
  draw.shuffle(seen);
  const auto hidden = static_cast<std::size_t>(options.hidden * static_cast<double>(seen.size()));
  seen.resize(seen.size() - hidden);
  for (SeenPixel& s : seen) {
    const double du = draw.gauss(), dv = draw.gauss();
    s.pixel += Eigen::Vector2d(du, dv) * options.noise_px;
  }
  return seen;
}

SeenPixel clutter_dot(const CardProblemOptions& options, const Eigen::Vector2d& centre, double radius,
                      Draw& draw) {
  const Eigen::Vector2d middle(0.5 * (kSide - 1), 0.5 * (kSide - 1));
  for (;;) {
    const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1);
    if (x * x + y * y > 1) continue;
    const Eigen::Vector2d at = options.clutter_on_card
                                   ? Eigen::Vector2d(centre + 1.3 * radius * Eigen::Vector2d(x, y))
                                   : Eigen::Vector2d(middle + 0.5 * kSide * Eigen::Vector2d(x, y));
    if ((at - middle).norm() < 0.5 * kSide - 1) return {at, -1};
  }
}

}  // namespace

CardProblem make_card_problem(const CardProblemOptions& options, std::uint64_t seed) {
  Draw draw(seed);
  CardProblem problem;
  problem.body = random_body(options, draw);
  const std::vector<RigCamera> cameras = cameras_of(options);

  // Somewhere in the first camera's field, facing it, then tilted and rolled.
  const double off = std::acos(draw.uniform(std::cos(options.largest_off_axis_deg * kDegree), 1.0));
  const double azimuth = draw.uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector3d sight(std::sin(off) * std::cos(azimuth), std::sin(off) * std::sin(azimuth),
                              std::cos(off));
  const Eigen::Vector3d tilt_axis = sight.cross(draw.direction()).normalized();
  const double tilt = draw.uniform(0, options.largest_tilt_deg) * kDegree;
  const double roll = draw.uniform(-std::numbers::pi, std::numbers::pi);
  problem.truth.rotation = rotation_exp(tilt_axis * tilt) *
                           Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -sight) *
                           rotation_exp(Eigen::Vector3d(0, 0, roll));
  if (options.solid || options.faces)
    problem.truth.rotation = rotation_exp(draw.direction() * draw.uniform(0, 3.1));
  problem.truth.translation = sight * options.range;

  for (std::size_t k = 0; k < cameras.size(); ++k) {
    Eigen::Vector2d centre;
    double radius;
    std::vector<SeenPixel> seen = see_targets(problem, cameras[k], options, draw, centre, radius);
    const auto clutter = static_cast<int>(
        std::lround(options.clutter / (1 - options.clutter) * static_cast<double>(seen.size())));
    const int wanted = options.body_present ? clutter : clutter + static_cast<int>(seen.size());
    if (!options.body_present) seen.clear();
    for (int i = 0; i < wanted; ++i) seen.push_back(clutter_dot(options, centre, radius, draw));
    draw.shuffle(seen);
    for (const SeenPixel& s : seen) {
      Dot dot;
      dot.pixel = s.pixel;
      dot.covariance = Eigen::Matrix2d::Identity() * options.noise_px * options.noise_px;
      RigDot ray;
      if (!rig_dot(dot, static_cast<std::uint16_t>(problem.dots.size()), cameras[k],
                   static_cast<std::uint8_t>(k), 0, ray))
        continue;
      problem.dots.push_back(ray);
      problem.target_of_dot.push_back(s.target);
    }
  }
  return problem;
}

}  // namespace omma
