#include "ground/calibrate/star_pairing.hpp"

#include <limits>

namespace omma::ground {
namespace {

struct Expected {
  const SkyStar* star;
  Eigen::Vector2d pixel;
};

std::vector<Expected> expected_in(const RigCamera& camera, const Eigen::Quaterniond& rig_from_j2000,
                                  std::span<const SkyStar> stars, std::size_t most) {
  const Eigen::Quaterniond camera_from_j2000 = camera.rig_from_camera.rotation.conjugate() * rig_from_j2000;
  std::vector<Expected> expected;
  for (const SkyStar& star : stars) {
    Eigen::Vector2d pixel;
    if (!camera.lens.project(camera_from_j2000 * star.direction, pixel)) continue;
    expected.push_back({&star, pixel});
    if (expected.size() >= most) break;
  }
  return expected;
}

// Index of the point nearest to `at`; none (−1) where it is beyond `gate` or another is within twice that.
template <class Points, class PixelOf>
int only_one_near(const Points& points, const PixelOf& pixel_of, const Eigen::Vector2d& at, double gate) {
  int nearest = -1;
  double first = std::numeric_limits<double>::infinity();
  double second = first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away = (pixel_of(points[i]) - at).norm();
    if (away < first) {
      second = first;
      first = away;
      nearest = static_cast<int>(i);
    } else {
      second = std::min(second, away);
    }
  }
  return first <= gate && second > 2 * gate ? nearest : -1;
}

}  // namespace

void pair_by_place(const DotLists& dots, const Rig& rig, const Eigen::Quaterniond& rig_from_j2000,
                   std::span<const SkyStar> stars, double gate, int frame, std::vector<StarSight>& sights) {
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const auto& list = dots.cameras[c].dots;
    const std::vector<Expected> expected = expected_in(rig.cameras[c], rig_from_j2000, stars, list.size());
    for (const Dot& dot : list) {
      if ((dot.flags & (kDotAtEdge | kDotSaturated)) != 0) continue;
      const int star = only_one_near(
          expected, [](const Expected& e) { return e.pixel; }, dot.pixel, gate);
      if (star < 0) continue;
      const Expected& found = expected[static_cast<std::size_t>(star)];
      const int back = only_one_near(
          list, [](const Dot& d) { return d.pixel; }, found.pixel, gate);
      if (back < 0 || &list[static_cast<std::size_t>(back)] != &dot) continue;
      sights.push_back({frame, static_cast<int>(c), found.star->hr, found.star->direction, dot.pixel,
                        dot.covariance, dot.snr});
    }
  }
}

}  // namespace omma::ground
