#include "tests/bench/cold_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr float kTargetFlux = 1e5F;
constexpr int kMargin = 4;  // px from the image's edge

float flux_of(double magnitude) {
  return static_cast<float>(1e4 * std::pow(10, -0.4 * magnitude));
}

class FrameMaker {
 public:
  FrameMaker(const Rig& rig, const ColdFrameOptions& options, std::uint64_t seed)
      : rig_(rig), options_(options), random_(seed * 0x9e3779b97f4a7c15ULL + 5) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double gauss() { return gauss_(random_); }
  Eigen::Vector3d direction() {
    const double x = gauss(), y = gauss(), z = gauss();
    return Eigen::Vector3d(x, y, z).normalized();
  }

  /// Somewhere in the first camera's field, facing it, then tilted and rolled.
  Pose place_card() {
    const RigCamera& camera = rig_.cameras[0];
    const double off = std::acos(uniform(std::cos(options_.largest_off_axis_deg * kDegree), 1));
    const double azimuth = uniform(-std::numbers::pi, std::numbers::pi);
    const Eigen::Vector3d sight(std::sin(off) * std::cos(azimuth), std::sin(off) * std::sin(azimuth),
                                std::cos(off));
    const Eigen::Vector3d axis = sight.cross(direction()).normalized();
    const double tilt = uniform(0, options_.largest_tilt_deg) * kDegree;
    const double roll = uniform(-std::numbers::pi, std::numbers::pi);
    Pose in_camera;
    in_camera.rotation = rotation_exp(axis * tilt) *
                         Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -sight) *
                         rotation_exp(Eigen::Vector3d(0, 0, roll));
    in_camera.translation = sight * options_.range;
    return camera.rig_from_camera * in_camera;
  }

  /// @param direction  unit, rig frame, as camera `c` sees it
  void add(std::size_t c, const Eigen::Vector3d& direction, float flux, DotLists& lists) {
    const RigCamera& camera = rig_.cameras[c];
    Eigen::Vector2d pixel;
    if (!camera.lens.project(camera.rig_from_camera.rotation.conjugate() * direction, pixel)) return;
    const double a = gauss(), b = gauss();
    add_at(c, pixel + options_.noise_px * Eigen::Vector2d(a, b), flux, lists);
  }

  void add_false(std::size_t c, float flux, DotLists& lists) {
    const Lens& lens = rig_.cameras[c].lens;
    const double x = uniform(kMargin, lens.width() - kMargin), y = uniform(kMargin, lens.height() - kMargin);
    add_at(c, {x, y}, flux, lists);
  }

 private:
  void add_at(std::size_t c, const Eigen::Vector2d& pixel, float flux, DotLists& lists) {
    const Lens& lens = rig_.cameras[c].lens;
    Eigen::Vector3d ray;
    if (pixel.x() < kMargin || pixel.y() < kMargin || pixel.x() > lens.width() - kMargin ||
        pixel.y() > lens.height() - kMargin || !lens.bearing(pixel, ray))
      return;
    Dot dot;
    dot.pixel = pixel;
    dot.covariance = options_.noise_px * options_.noise_px * Eigen::Matrix2d::Identity();
    dot.flux = flux;
    dot.snr = 100;
    lists.cameras[c].dots.push_back(dot);
  }

  const Rig& rig_;
  const ColdFrameOptions& options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> gauss_;
};

}  // namespace

ColdFrame make_cold_frame(const Rig& rig, std::span<const SkyStar> stars, const TargetBody& body,
                          const ColdFrameOptions& options, std::uint64_t seed, DotLists& lists) {
  FrameMaker frame(rig, options, seed);
  ColdFrame truth;
  truth.rig_from_j2000 = rotation_exp(frame.direction() * frame.uniform(0, std::numbers::pi));
  truth.rig_from_body = frame.place_card();
  std::size_t visible = 0;  // brightest first
  while (visible < stars.size() && stars[visible].magnitude <= options.magnitude_limit) ++visible;
  lists.frame = seed + 1;
  lists.time_ns = static_cast<TimeNs>(seed + 1) * 100'000'000;
  lists.cameras.resize(rig.cameras.size());
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    DotList& list = lists.cameras[c];
    list = {};
    list.status = FrameStatus::kFresh;
    for (const SkyStar& star : stars.first(visible)) {
      frame.add(c, truth.rig_from_j2000 * star.direction, flux_of(star.magnitude + 0.3 * frame.gauss()),
                lists);
    }
    for (const Target& target : body.targets) {
      const Eigen::Vector3d d =
          truth.rig_from_body * target.position - rig.cameras[c].rig_from_camera.translation;
      if (options.card) frame.add(c, d.normalized(), kTargetFlux, lists);
    }
    const auto seen = static_cast<double>(list.dots.size());
    const auto wanted = std::lround(seen * options.false_fraction / (1 - options.false_fraction));
    for (long i = 0; i < wanted; ++i) {
      const auto any = static_cast<std::size_t>(frame.uniform(0, static_cast<double>(visible)));
      const double magnitude =
          options.bright_false ? frame.uniform(0, options.magnitude_limit) : stars[any].magnitude;
      frame.add_false(c, flux_of(magnitude), lists);
    }
    std::stable_sort(list.dots.begin(), list.dots.end(),
                     [](const Dot& a, const Dot& b) { return a.flux > b.flux; });
  }
  return truth;
}

}  // namespace omma
