// PlateView: one flat face of a body as one camera sees it at one instant: what it hides, and the face itself
// laid over the image. Geometry in docs/algorithms/simulation.md#cards.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "sim/camera_view.hpp"
#include "sim/scenario.hpp"

namespace omma::sim {

/// Faces of one body put together, a value a pixel: how much of it they cover, and their light [electrons];
/// empty where no face is in the image.
struct FaceLayer {
  std::vector<float> covered, light;
};

class PlateView;

/// What a face shines with [electrons a steradian on the optical axis]: in the Sun, and where another face
/// keeps the Sun from it.
struct FaceLight {
  double lit = 0;
  double shaded = 0;
  std::vector<const PlateView*> occluders;            ///< none: no shadow falls on it
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();  ///< camera frame, unit

  bool in_shade(const Eigen::Vector3d& point) const;  ///< point in the camera frame
};

class PlateView {
 public:
  PlateView(const CameraView& camera, const Face& face, const Pose& camera_from_face);

  const Pose& camera_from_face() const { return camera_from_face_; }
  /// The camera's centre in the face's axes [m].
  const Eigen::Vector3d& eye() const { return eye_; }
  /// Distance of the face's middle from the camera [m].
  double distance() const { return camera_from_face_.translation.norm(); }

  /// Whether the face stands between the camera and a point `distance` [m] away in the direction (camera
  /// frame, unit).
  bool hides(const Eigen::Vector3d& direction,
             double distance = std::numeric_limits<double>::infinity()) const;

  /// Whether the face stands between a point (camera frame) and the Sun in the direction `to_sun`.
  bool shades(const Eigen::Vector3d& point, const Eigen::Vector3d& to_sun) const;
  /// Whether any of the face lies on the Sun's side of the other's plane, as what throws a shadow on it must.
  bool stands_before(const PlateView& other, const Eigen::Vector3d& to_sun) const;

  /// Lays the face over `electrons` (width × height): its light replaces what is behind; its edge is as soft
  /// as the point spread. Seen from behind it is a plate as well.
  void paint(const FaceLight& light, std::vector<float>& electrons) const;
  /// Lays the face over those behind it. Two that share an edge leave no seam between them.
  void join(const FaceLight& light, FaceLayer& layer) const;

 private:
  struct Box {
    int u0, v0, u1, v1;  // pixels [u0, u1) × [v0, v1)
  };
  template <class Lay>
  void lay(const FaceLight& light, const Lay& one_pixel) const;
  bool find_box(Box& box) const;
  bool tighten(Box& box, std::vector<float>& covered) const;
  // Share of each pixel whose rays are of one kind: `is(ray)`.
  template <class Is>
  std::vector<float> coverage(const Box& box, const Is& is) const;
  template <class Is>
  static float coverage_of_pixel(const Eigen::Vector3f* upper, const Eigen::Vector3f* lower, const Is& is);
  bool covers(const Eigen::Vector3f& ray) const;
  bool covers_in_shade(const Eigen::Vector3f& ray, const FaceLight& light) const;

  const CameraView& camera_;
  double width_, height_;
  Pose camera_from_face_;
  Eigen::Vector3d eye_;
  Eigen::Matrix3f face_from_camera_;  // for the many rays of the plate
};

}  // namespace omma::sim
