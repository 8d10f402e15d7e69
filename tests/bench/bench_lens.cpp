// The lens models in both directions: time per call over 1000 random directions of the image, beside one call
// of std::atan2 and std::sqrt on the same directions, which the textbook fisheye projection needs at least.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "components/geometry/lens.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kCalls = 1000;

struct Case {
  const char* name;
  Lens lens;
};

std::vector<Case> cases() {
  // The equidistant lens of f = 300 px as an OCamCalib file of twelve powers has it.
  const std::vector<double> twelve = {299.9999950713,      0, -1.111109876074e-03, 0, -8.231329006880e-10, 0,
                                      -8.682589913686e-16, 0, -1.009132091370e-21, 0, -7.555084060987e-28, 0,
                                      -2.472764328894e-33};
  const std::vector<double> four = {259.5395, 0, -1.626945e-03, 2.328091e-06, -6.601777e-09};
  const Eigen::Vector2d centre(511.5, 383.5);
  return {
      {"OCamCalib, 12 powers", Lens::ocam(1024, 768, centre, Eigen::Matrix2d::Identity(), twelve)},
      {"OCamCalib, 4 powers", Lens::ocam(752, 480, {364.4, 229.6}, Eigen::Matrix2d::Identity(), four)},
      {"Kannala-Brandt", Lens::kannala_brandt(1024, 768, {330, 330}, centre, {-0.027, 0.02, -0.01, 0.001})},
      {"Caltech, distorted",
       Lens::caltech(1024, 768, {600, 600}, centre, 0, {-0.31, 0.12, 0.0011, -0.0008, -0.02})},
      {"Caltech, pinhole", Lens::pinhole(1024, 768, 90 * kDegree)},
  };
}

// Median time of one call [ns] over `batches` batches; the sum keeps the calls from being left out.
template <class Call>
double nanoseconds(int batches, double& sum, Call&& call) {
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(batches));
  for (int b = 0; b < batches; ++b) {
    samples.push_back(1000.0 / kCalls * microseconds([&] {
                        for (std::size_t i = 0; i < kCalls; ++i) sum += call(i);
                      }));
  }
  return quantile(samples, 0.5);
}

void run(const Case& c, int batches, double& sum) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0, c.lens.width() - 1);
  std::uniform_real_distribution<double> v(0, c.lens.height() - 1);
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> rays;
  while (pixels.size() < kCalls) {
    const double x = u(random), y = v(random);
    Eigen::Vector3d ray;
    if (!c.lens.bearing({x, y}, ray)) continue;
    pixels.emplace_back(x, y);
    rays.push_back(ray);
  }
  Eigen::Vector2d pixel;
  Eigen::Vector3d ray;
  Eigen::Matrix<double, 2, 3> by_direction;
  Eigen::Matrix<double, 3, 2> by_pixel;
  double worst = 0;
  for (std::size_t i = 0; i < kCalls; ++i) {
    if (c.lens.project(rays[i], pixel)) worst = std::max(worst, (pixel - pixels[i]).norm());
  }
  const double reference = nanoseconds(batches, sum, [&](std::size_t i) {
    return std::atan2(std::sqrt(rays[i].x() * rays[i].x() + rays[i].y() * rays[i].y()), rays[i].z());
  });
  const double project = nanoseconds(
      batches, sum, [&](std::size_t i) { return c.lens.project(rays[i], pixel) ? pixel.x() : 0; });
  const double project_j = nanoseconds(batches, sum, [&](std::size_t i) {
    return c.lens.project(rays[i], pixel, by_direction) ? by_direction(0, 0) : 0;
  });
  const double bearing =
      nanoseconds(batches, sum, [&](std::size_t i) { return c.lens.bearing(pixels[i], ray) ? ray.x() : 0; });
  const double bearing_j = nanoseconds(batches, sum, [&](std::size_t i) {
    return c.lens.bearing(pixels[i], ray, by_pixel) ? by_pixel(0, 0) : 0;
  });
  std::printf("%-22s %5.0f (%4.1f)  %5.0f (%4.1f)  %5.0f (%4.1f)  %5.0f (%4.1f)   %5.1f   %8.1e\n", c.name,
              project, project / reference, project_j, project_j / reference, bearing, bearing / reference,
              bearing_j, bearing_j / reference, reference, worst);
}

}  // namespace

int bench_lens(Options& options) {
  int batches = 501;
  options.add("--batches", batches, "of 1000 calls; the median is printed");
  options.read();
  std::printf("ns per call, median of %d batches of %zu (ratio to sqrt and atan2 alone)\n", batches, kCalls);
  std::printf("%-22s %12s  %12s  %12s  %12s   %5s   %s\n", "lens", "project", "+ Jacobian", "bearing",
              "+ Jacobian", "atan2", "round trip [px]");
  double sum = 0;
  for (const Case& c : cases()) run(c, batches, sum);
  return std::isfinite(sum) ? 0 : 1;
}

}  // namespace omma
