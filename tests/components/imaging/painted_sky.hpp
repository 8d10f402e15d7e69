// A sky painted through lenses: images of a rig whose every pixel is a known function of the direction it
// sees.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "components/geometry/rig.hpp"
#include "hal/image.hpp"

namespace omma::testing {

/// Share of the white level that a J2000 direction sends.
using PaintedSky = std::function<double(const Eigen::Vector3d& direction)>;

struct PaintedImages {
  std::vector<std::vector<std::uint16_t>> pixels;
  std::vector<ImageView> views;
};

/// Three fisheyes on the faces of a tetrahedron, as the rig of the dissertation, at a third of its
/// resolution.
inline Rig tetrahedral_rig() {
  Rig rig;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Quaterniond tilt(
      Eigen::AngleAxisd(109.471 * std::numbers::pi / 180, Eigen::Vector3d::UnitY()));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(120.0 * std::numbers::pi / 180, z));
  const Lens wide = Lens::equidistant(341, 341, 100, {170, 170}, 1.63);
  const Lens narrow = Lens::equidistant(256, 192, 100, {127.5, 95.5}, 1.4);
  rig.cameras.push_back({Name("hdr1"), narrow, {Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()}});
  rig.cameras.push_back({Name("cam0"), wide, {tilt, 0.1 * x}});
  rig.cameras.push_back({Name("cam2"), wide, {turn * tilt, -0.1 * x}});
  return rig;
}

inline PaintedImages paint(const Rig& rig, const Eigen::Quaterniond& rig_from_j2000, const PaintedSky& sky,
                           std::uint16_t white_level = 4095) {
  PaintedImages images;
  images.pixels.resize(rig.cameras.size());
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const Lens& lens = rig.cameras[i].lens;
    const Eigen::Quaterniond j2000_from_camera =
        rig_from_j2000.conjugate() * rig.cameras[i].rig_from_camera.rotation;
    std::vector<std::uint16_t>& pixels = images.pixels[i];
    pixels.resize(static_cast<std::size_t>(lens.width()) * lens.height(), 0);
    for (int v = 0; v < lens.height(); ++v) {
      for (int u = 0; u < lens.width(); ++u) {
        Eigen::Vector3d ray;
        if (!lens.bearing(Eigen::Vector2d(u, v), ray)) continue;
        pixels[static_cast<std::size_t>(v) * lens.width() + u] =
            static_cast<std::uint16_t>(std::lround(white_level * sky(j2000_from_camera * ray)));
      }
    }
    images.views.push_back({reinterpret_cast<const std::byte*>(pixels.data()), lens.width(), lens.height(),
                            lens.width() * 2, PixelFormat::kGrey16, white_level});
  }
  return images;
}

}  // namespace omma::testing
