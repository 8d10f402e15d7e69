// CardView: a body with targets as one camera sees it at one instant: its faces, printed discs and lamps, and
// what it hides. Geometry and light in docs/algorithms/simulation.md#cards.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sim/camera_view.hpp"
#include "sim/disc_quadrature.hpp"
#include "sim/plate_view.hpp"
#include "sim/scenario.hpp"
#include "sim/spot.hpp"

namespace omma::sim {

/// The Sun on a body; nothing in the Earth's shadow.
struct Sunlight {
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();  ///< camera frame, unit
  double flux = 0;                                    ///< in units of a star of V = 0
};

class CardView {
 public:
  /// @param sunlight  what surfaces with an albedo shine with
  CardView(const CameraView& camera, const Card& card, const Pose& rig_from_body,
           const std::optional<Sunlight>& sunlight = {});

  /// Distance of the body's origin from the camera [m].
  double distance() const { return camera_from_body_.translation.norm(); }

  /// Whether a face stands between the camera and a point `distance` [m] away in the direction (camera
  /// frame, unit).
  bool hides(const Eigen::Vector3d& direction,
             double distance = std::numeric_limits<double>::infinity()) const;

  /// Lays the faces over the sky of `electrons` (width × height), the far ones first.
  /// @param cards  all of the scene, which throw shadows on each other; their order is the scenario's
  void paint(std::span<const CardView> cards, std::vector<float>& electrons) const;

  /// Where the disc `target` has its centre in the image; false if it turns away, is behind another face of
  /// the body, or out of the field.
  bool disc_centre(std::size_t target, Eigen::Vector2d& pixel, Eigen::Vector3d& direction,
                   double& distance) const;

  /// Appends the disc's points of light, `share` of one exposure; a dark disc's are negative.
  void add_disc(std::size_t target, double share, const DiscQuadrature& quadrature,
                std::span<const CardView> cards, std::vector<PointSource>& points) const;

 private:
  const PlateView& face_of(std::size_t target) const { return faces_[card_.face_of[target]]; }
  Eigen::Vector3d on_face(std::size_t target) const;
  bool faces_camera(std::size_t target) const;
  bool is_lamp(std::size_t target) const;
  FaceLight plate_light(const PlateView& face, std::span<const CardView> cards) const;
  FaceLight disc_light(const PlateView& face) const;
  FaceLight printed_light(const PlateView& face, double albedo) const;
  std::vector<const PlateView*> occluders(const PlateView& face, std::span<const CardView> cards) const;

  const CameraView& camera_;
  const Card& card_;
  Pose camera_from_body_;
  std::optional<Sunlight> sunlight_;
  std::vector<PlateView> faces_;
};

}  // namespace omma::sim
