// Dot lists of a sky whose attitude is known: every star brighter than a limit, at its place in each image,
// with noise. For the tests of tracking.
#pragma once

#include <cmath>
#include <random>

#include "components/catalogue/star_catalogue.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"

namespace omma {

class SeenSky {
 public:
  SeenSky(const Rig& rig, const StarCatalogue& catalogue, float magnitude_limit, double noise_px)
      : rig_(rig), catalogue_(catalogue), magnitude_limit_(magnitude_limit), noise_px_(noise_px) {}

  /// Fills `lists`; `hr(camera, dot)` then tells the true star of each dot.
  void see(const Eigen::Quaterniond& rig_from_j2000, DotLists& lists) {
    lists.cameras.resize(rig_.cameras.size());
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      DotList& list = lists.cameras[c];
      list = {};
      list.status = FrameStatus::kFresh;
      for (const SkyStar& star : catalogue_.stars()) {  // brightest first, as the dots shall be
        if (star.magnitude > magnitude_limit_) break;
        const RigCamera& camera = rig_.cameras[c];
        Dot dot;
        if (!camera.lens.project(
                camera.rig_from_camera.rotation.conjugate() * (rig_from_j2000 * star.direction), dot.pixel))
          continue;
        if (dot.pixel.x() < 3 || dot.pixel.y() < 3 || dot.pixel.x() > camera.lens.width() - 4 ||
            dot.pixel.y() > camera.lens.height() - 4)
          continue;
        const double a = gauss_(random_);
        const double b = gauss_(random_);
        dot.pixel += noise_px_ * Eigen::Vector2d(a, b);
        dot.covariance = noise_px_ * noise_px_ * Eigen::Matrix2d::Identity();
        dot.flux = 1e4F * std::pow(10.0F, -0.4F * star.magnitude);
        dot.snr = 100;
        hr_[c][list.dots.size()] = star.hr;
        if (!list.dots.push_back(dot)) break;
      }
    }
  }

  std::uint16_t hr(std::size_t camera, std::size_t dot) const { return hr_[camera][dot]; }

 private:
  const Rig& rig_;
  const StarCatalogue& catalogue_;
  float magnitude_limit_;
  double noise_px_;
  std::mt19937_64 random_{2010};
  std::normal_distribution<double> gauss_;
  std::array<std::array<std::uint16_t, limits::kDotsPerCamera>, limits::kCameras> hr_{};
};

}  // namespace omma
