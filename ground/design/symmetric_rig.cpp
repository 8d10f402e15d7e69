#include "ground/design/symmetric_rig.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace omma::ground {
namespace {

Eigen::Vector3d on_equator(double turns) {
  return {std::cos(2 * std::numbers::pi * turns), std::sin(2 * std::numbers::pi * turns), 0};
}

// Unit axes, and the distance of each camera from the middle for neighbours one metre apart.
struct Outward {
  Eigen::Vector3d axis;
  double radius;
};

std::vector<Outward> arrangement(int cameras) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const double triangle = 1 / std::sqrt(3.0);
  switch (cameras) {
    case 2:
      return {{z, 0.5}, {-z, 0.5}};
    case 3:
      return {{on_equator(0), triangle}, {on_equator(1.0 / 3), triangle}, {on_equator(2.0 / 3), triangle}};
    case 4: {
      const double radius = std::sqrt(6.0) / 4;
      std::vector<Outward> all{{z, radius}};
      for (int k = 0; k < 3; ++k) all.push_back({std::sqrt(8.0) / 3 * on_equator(k / 3.0) - z / 3, radius});
      return all;
    }
    case 5: {
      const double pole = std::sqrt(2.0 / 3);  // so that the edge from pole to equator is one too
      std::vector<Outward> all{{z, pole}, {-z, pole}};
      for (int k = 0; k < 3; ++k) all.push_back({on_equator(k / 3.0), triangle});
      return all;
    }
    default: {
      const double radius = std::sqrt(0.5);
      std::vector<Outward> all{{z, radius}, {-z, radius}};
      for (int k = 0; k < 4; ++k) all.push_back({on_equator(k / 4.0), radius});
      return all;
    }
  }
}

}  // namespace

std::vector<CameraPlace> symmetric_places(int cameras, double spacing) {
  std::vector<CameraPlace> places;
  for (const Outward& one : arrangement(cameras))
    places.push_back({one.radius * spacing * one.axis, one.axis});
  return places;
}

const char* symmetric_name(int cameras) {
  constexpr std::array kNames{"back to back", "triangle", "tetrahedron", "triangular bipyramid",
                              "octahedron"};
  return kNames[static_cast<std::size_t>(cameras - kFewestSymmetric)];
}

std::vector<CameraPlace> places_of(const Rig& rig) {
  std::vector<CameraPlace> places;
  for (const RigCamera& camera : rig.cameras) {
    places.push_back(
        {camera.rig_from_camera.translation, camera.rig_from_camera.rotation * Eigen::Vector3d::UnitZ()});
  }
  return places;
}

Rig rig_of(const std::vector<CameraPlace>& places, const Lens& lens) {
  Rig rig;
  rig.name = Name("symmetric");
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Eigen::Vector3d z = places[k].axis;
    const bool polar = z.head<2>().norm() < 1e-6;
    const Eigen::Vector3d x =
        polar ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ().cross(z).normalized();
    Eigen::Matrix3d rotation;
    rotation << x, z.cross(x), z;
    RigCamera camera;
    camera.name = Name("cam" + std::to_string(k));
    camera.lens = lens;
    camera.rig_from_camera = {Eigen::Quaterniond(rotation).normalized(), places[k].centre};
    rig.cameras.push_back(camera);
  }
  return rig;
}

}  // namespace omma::ground
