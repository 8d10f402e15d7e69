// CameraRenderer: one camera's images of a scenario, into the caller's buffers. Each image depends on the
// scenario and the frame number alone, so that cameras and frames may be rendered in any order, on any number
// of threads (one renderer a thread).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/camera_view.hpp"
#include "sim/scenario.hpp"
#include "sim/sky_spots.hpp"
#include "sim/spot_truth.hpp"

namespace omma::sim {

class CameraRenderer {
 public:
  /// @param scenario, stars, view  stay with the caller; the view is of the rig's camera `index`
  CameraRenderer(const Scenario& scenario, std::span<const SkyStar> stars, const CameraView& view, int index);

  /// Works out the expected electrons of frame `frame`.
  void draw(std::uint64_t frame);
  std::span<const float> mean_electrons() const { return electrons_; }

  /// The spots of the frame drawn last, at least truth_minimum_snr bright.
  void truth(std::vector<SpotTruth>& out);

  /// Grey levels of the frame drawn last: width × height, 8 bits for a sensor of 8 bits, else 16.
  void read_out(std::span<std::uint8_t> grey) const;
  void read_out(std::span<std::uint16_t> grey) const;

 private:
  double drawn_time(std::uint64_t frame, int sample) const;
  Eigen::Matrix3d camera_from_j2000(const SceneInstant& instant) const;
  void add_sky(const SceneInstant& midpoint, std::span<const SceneInstant> drawn,
               std::span<const CardView> cards);
  void add_stray_sunlight(const Eigen::Vector3d& sun, std::span<const CardView> cards);
  void add_cards(std::span<const SceneInstant> drawn, std::span<const CardView> cards);

  const Scenario& scenario_;
  std::span<const SkyStar> stars_;
  const CameraView& view_;
  int index_;
  DiscQuadrature quadrature_;
  std::uint64_t frame_ = 0;
  std::vector<float> electrons_;
  SpotList list_;
  Patch patch_;
};

}  // namespace omma::sim
