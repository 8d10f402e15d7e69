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
#include "sim/sky_glow.hpp"
#include "sim/sky_scene.hpp"
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
  CameraTurn turn_of(const SceneInstant& instant) const;
  std::optional<Sunlight> sunlight(const SkyScene& sky, const SkyView& view) const;
  void add_background(const SkyScene& sky, const SkyView& view);
  void add_sky(const SkyScene& sky, const SkyView& view, std::span<const CardView> cards);
  void add_stray_light(const SkyScene& sky, const SkyView& view, std::span<const CardView> cards);
  void add_cards(std::span<const SceneInstant> drawn, const std::optional<Sunlight>& sunlight,
                 std::span<const CardView> cards);

  const Scenario& scenario_;
  std::span<const SkyStar> stars_;
  const CameraView& view_;
  int index_;
  ColourFactors colours_;
  std::vector<float> star_factors_;  // of each star's light, by its colour; empty: one
  SkyGlow glow_;
  DiscQuadrature quadrature_;
  std::uint64_t frame_ = 0;
  std::vector<float> electrons_;
  SpotList list_;
  Patch patch_;
};

}  // namespace omma::sim
