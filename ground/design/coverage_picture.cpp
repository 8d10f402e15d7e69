#include "ground/design/coverage_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace omma::ground {
namespace {

constexpr int kFooter = 46;
constexpr double kText = 13;
constexpr double kDegree = std::numbers::pi / 180;
// None, one, two … cameras: blind is red, then ever lighter blue.
constexpr std::array<Colour, limits::kCameras + 1> kColours{{{0.75, 0.12, 0.16, 1},
                                                             {0.10, 0.21, 0.36, 1},
                                                             {0.13, 0.38, 0.60, 1},
                                                             {0.22, 0.56, 0.74, 1},
                                                             {0.45, 0.73, 0.80, 1},
                                                             {0.70, 0.86, 0.84, 1},
                                                             {0.92, 0.96, 0.90, 1}}};

void paint(Canvas& canvas, const CoverageMap& map) {
  for (int v = 0; v < map.height; ++v) {
    for (int u = 0; u < map.width;) {
      const auto at = [&](int column) {
        return map.cameras[static_cast<std::size_t>(v) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(column)];
      };
      int end = u;
      while (end < map.width && at(end) == at(u)) ++end;
      canvas.fill_box({u - 0.5, v - 0.5, end - 0.5, v + 0.5}, kColours[at(u)]);
      u = end;
    }
  }
}

void grid(Canvas& canvas, int width, int height) {
  const Colour line = Colour{}.with_alpha(0.18);
  for (int longitude = -150; longitude <= 150; longitude += 30) {
    const double u = 0.5 * width * (1 - longitude / 180.0) - 0.5;
    const std::array<Eigen::Vector2d, 2> ends{{{u, 0}, {u, 1.0 * height}}};
    canvas.line(ends, line, 1);
  }
  for (int latitude = -60; latitude <= 60; latitude += 30) {
    const double v = height * (0.5 - latitude / 180.0) - 0.5;
    const std::array<Eigen::Vector2d, 2> ends{{{0, v}, {1.0 * width, v}}};
    canvas.line(ends, line, 1);
  }
  const std::array<std::pair<Eigen::Vector3d, const char*>, 6> axes{{{{1, 0, 0}, "+x"},
                                                                     {{-1, 1e-9, 0}, "−x"},
                                                                     {{0, 1, 0}, "+y"},
                                                                     {{0, -1, 0}, "−y"},
                                                                     {{0, 0, 1}, "+z"},
                                                                     {{0, 0, -1}, "−z"}}};
  for (const auto& [axis, name] : axes) {
    Eigen::Vector2d at = map_place(axis, width, height);
    at.x() = std::clamp(at.x() + 4, 4.0, width - 26.0);
    at.y() = std::clamp(at.y() - 4, kText + 3, height - 5.0);
    canvas.text(at, name, kText, Colour{1, 1, 1, 0.75});
  }
}

void camera_axes(Canvas& canvas, const PaperRig& paper, int width, int height) {
  for (const RigCamera& camera : paper.rig.cameras) {
    const Eigen::Vector3d axis = camera.rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
    const Eigen::Vector2d at = map_place(axis, width, height);
    canvas.circle(at, 7, {1, 0.83, 0.3, 1}, 2);
    canvas.disc(at, 2, {1, 0.83, 0.3, 1});
    const std::string name(camera.name.view());
    const double half = 0.5 * (canvas.text_box(at, name, kText).right - at.x());
    canvas.text({std::clamp(at.x() - half, 4.0, width - 2 * half - 4),
                 at.y() > height - 40 ? at.y() - 13 : at.y() + 24},
                name, kText, {1, 0.83, 0.3, 1});
  }
}

void blind_marks(Canvas& canvas, const Coverage& coverage, int width, int height) {
  int drawn = 0;
  for (const BlindSpot& spot : coverage.blind) {
    if (++drawn > 12) break;
    const Eigen::Vector2d at = map_place(spot.middle, width, height);
    canvas.text({std::clamp(at.x() - 18, 4.0, width - 60.0), std::clamp(at.y() + 4, 16.0, height - 6.0)},
                std::to_string(drawn), kText, Colour{});
  }
}

void legend(Canvas& canvas, const Coverage& coverage, int width, int height) {
  canvas.fill_box({-0.5, height - 0.5, width - 0.5, 1.0 * height + kFooter}, {0.06, 0.07, 0.09, 1});
  double left = 12;
  for (std::size_t count = 0; count < kColours.size(); ++count) {
    if (coverage.share[count] < 5e-5) continue;
    canvas.fill_box({left, height + 14.0, left + 18, height + 32.0}, kColours[count]);
    std::array<char, 64> text{};
    std::snprintf(
        text.data(), text.size(), "%s %.1f %%",
        count == 0 ? "blind" : (std::to_string(count) + (count == 1 ? " camera" : " cameras")).c_str(),
        100 * coverage.share[count]);
    canvas.text({left + 25, height + 28.0}, text.data(), kText, Colour{});
    left += 40 + canvas.text_box({0, 0}, text.data(), kText).right + 14;
  }
}

}  // namespace

Canvas coverage_picture(const PaperRig& paper, const Coverage& coverage, int width) {
  const CoverageMap map = coverage_map(paper, coverage.distance, width);
  Canvas canvas(map.width, map.height + kFooter);
  paint(canvas, map);
  grid(canvas, map.width, map.height);
  blind_marks(canvas, coverage, map.width, map.height);
  camera_axes(canvas, paper, map.width, map.height);
  legend(canvas, coverage, map.width, map.height);
  return canvas;
}

}  // namespace omma::ground
