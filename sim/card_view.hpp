// CardView: a docking card as one camera sees it at one instant: what its plate hides, the plate itself, and
// its discs. Geometry in docs/algorithms/simulation.md#cards.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "sim/camera_view.hpp"
#include "sim/disc_quadrature.hpp"
#include "sim/scenario.hpp"
#include "sim/spot.hpp"

namespace omma::sim {

class CardView {
 public:
  CardView(const CameraView& camera, const Card& card, const Pose& rig_from_body);

  /// Distance of the card's origin from the camera [m].
  double distance() const { return camera_from_body_.translation.norm(); }
  const Pose& camera_from_body() const { return camera_from_body_; }

  /// Whether the plate stands between the camera and a point `distance` [m] away in the direction (camera
  /// frame, unit).
  bool hides(const Eigen::Vector3d& direction,
             double distance = std::numeric_limits<double>::infinity()) const;

  /// Lays the plate over the empty sky of `electrons` (width × height): its light replaces the sky's; its
  /// edge is as soft as the point spread. Seen from behind it is a plate as well.
  void paint_plate(std::vector<float>& electrons) const;

  /// Where the card's disc `target` has its centre in the image; false if it turns away or is out of the
  /// field.
  bool disc_centre(std::size_t target, Eigen::Vector2d& pixel, Eigen::Vector3d& direction,
                   double& distance) const;

  /// Appends the disc's points of light, `share` of one exposure; a dark disc's are negative.
  void add_disc(std::size_t target, double share, const DiscQuadrature& quadrature,
                std::vector<PointSource>& points) const;

 private:
  struct Box {
    int u0, v0, u1, v1;  // pixels [u0, u1) × [v0, v1)
  };
  bool faces_camera(std::size_t target) const;
  bool plate_box(Box& box) const;
  std::vector<float> coverage(const Box& box) const;
  float coverage_of_pixel(const Eigen::Vector3f* upper, const Eigen::Vector3f* lower) const;
  bool on_plate(const Eigen::Vector3f& ray) const;

  const CameraView& camera_;
  const Card& card_;
  Pose camera_from_body_;
  Eigen::Vector3d eye_;               // camera centre, body frame [m]
  Eigen::Matrix3f body_from_camera_;  // for the many rays of the plate
};

}  // namespace omma::sim
