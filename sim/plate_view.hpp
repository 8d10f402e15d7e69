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

  /// Lays the face over `electrons` (width × height): its light replaces what is behind; its edge is as soft
  /// as the point spread. Seen from behind it is a plate as well.
  /// @param surface  electrons a steradian on the optical axis
  void paint(double surface, std::vector<float>& electrons) const;
  /// Lays the face over those behind it. Two that share an edge leave no seam between them.
  void join(double surface, FaceLayer& layer) const;

 private:
  struct Box {
    int u0, v0, u1, v1;  // pixels [u0, u1) × [v0, v1)
  };
  template <class Lay>
  void lay(double surface_light, const Lay& one_pixel) const;
  bool find_box(Box& box) const;
  bool tighten(Box& box, std::vector<float>& covered) const;
  std::vector<float> coverage(const Box& box) const;
  float coverage_of_pixel(const Eigen::Vector3f* upper, const Eigen::Vector3f* lower) const;
  bool covers(const Eigen::Vector3f& ray) const;

  const CameraView& camera_;
  double width_, height_;
  Pose camera_from_face_;
  Eigen::Vector3d eye_;
  Eigen::Matrix3f face_from_camera_;  // for the many rays of the plate
};

}  // namespace omma::sim
