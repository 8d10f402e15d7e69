// omma-bench axes: the axes of a swung platform and the shims between them, all of the pose at once against
// the dissertation's circle, with NEES.
#include <cmath>
#include <cstdio>

#include "ground/calibrate/axis_shims.hpp"
#include "ground/report/statistics.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/swung_platform.hpp"

namespace omma {
namespace {

struct Errors {
  double turn = 0;   // sum of squares
  double shift = 0;  // of the line where the true axis's point is
  int count = 0;
  void add(const ground::Axis& found, const ground::Axis& truth) {
    const Eigen::Vector3d off = found.point - truth.point;
    turn += found.direction.cross(truth.direction).squaredNorm();
    shift += (off - found.direction * found.direction.dot(off)).squaredNorm();
    ++count;
  }
  void print(const char* way) const {
    std::printf("%-28s direction %.4f deg, line %.3f mm rms\n", way, std::sqrt(turn / count) * 180 / M_PI,
                1e3 * std::sqrt(shift / count));
  }
};

ground::NamedAxis exactly(const ground::Axis& axis) {
  ground::NamedAxis named{"", {}};
  named.fit.axis = axis;
  return named;
}

}  // namespace

int bench_axes(Options& options) {
  int trials = 100;
  int arc = 57;
  Swing swing;
  swing.samples = 60;
  options.add("--trials", trials, "platforms");
  options.add("--samples", swing.samples, "poses of each axis", 6);
  options.add("--arc", arc, "that each axis swings through [degrees]");
  options.read();
  swing.arc = arc * M_PI / 180;
  Errors whole, circle;
  std::vector<double> nees;
  double shim_squares = 0;
  int failed = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const SwungPlatform platform = swung_platform(swing, static_cast<std::uint64_t>(trial));
    std::vector<ground::NamedAxis> found, truth;
    for (std::size_t a = 0; a < 3; ++a) {
      const ground::AxisFit fit = ground::fit_axis(platform.motions[a]);
      if (!fit.found) {
        ++failed;
        continue;
      }
      const ground::Axis& axis = platform.axes[a];
      whole.add(fit.axis, axis);
      circle.add(fit.circle, axis);
      const Eigen::Matrix<double, 3, 2> basis = tangent_basis(fit.axis.direction);
      // The true line where it passes the point that was found.
      const Eigen::Vector3d there = axis.point + axis.direction *
                                                     (fit.axis.point - axis.point).dot(fit.axis.direction) /
                                                     axis.direction.dot(fit.axis.direction);
      Eigen::Vector4d error;
      error << basis.transpose() * axis.direction, basis.transpose() * (there - fit.axis.point);
      nees.push_back(ground::squared_in_sigmas<4>(error, fit.covariance));
      found.push_back({"", fit});
      truth.push_back(exactly(axis));
    }
    if (found.size() < 3) continue;
    const auto shims = ground::axis_shims(found, std::nullopt);
    const auto right = ground::axis_shims(truth, std::nullopt);
    for (std::size_t a = 0; a < 3; ++a)
      shim_squares += (shims->shims[a].move - right->shims[a].move).squaredNorm() / (3 * trials);
  }
  std::printf(
      "%d trials of three axes, %d poses each over %.0f deg, good to %.3f deg, %.2f mm across and %.2f mm "
      "along\n",
      trials, swing.samples, swing.arc * 180 / M_PI, swing.turn_noise * 180 / M_PI, 1e3 * swing.shift_noise,
      3e3 * swing.shift_noise);
  whole.print("all of the pose");
  circle.print("circle of the dissertation");
  std::printf("shims %.3f mm rms\n", 1e3 * std::sqrt(shim_squares));
  const ground::MeanNees mean = ground::mean_nees(nees, 4);
  std::printf("NEES of an axis %.2f of 4 (%.2f to %.2f), %d axes not found\n", mean.mean, mean.low, mean.high,
              failed);
  return 0;
}

}  // namespace omma
