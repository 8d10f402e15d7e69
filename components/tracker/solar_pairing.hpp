// Pairs dots with Sun, Moon and planets. Planets are points and are assigned together with the stars, so that
// neither is taken for the other; Sun and Moon are discs that outshine everything, and are taken first.
#pragma once

#include <span>

#include "components/catalogue/solar_system.hpp"
#include "components/tracker/camera_prediction.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"

namespace omma {

class SolarPairing {
 public:
  /// Predictions with this entry and above are planets, not stars.
  static constexpr std::uint16_t kFirstEntry = 0xFF00;

  /// What to look for from now on; nothing where the epoch is not known. @param places  outlives the calls
  /// below
  void look_for(std::span<const SolarBodyPlace> places) noexcept { places_ = places; }

  void clear() noexcept { pairs_.clear(); }
  /// Claims the brightest dot where Sun or Moon is expected, if it is saturated, with all dots on its disc.
  void claim_discs(SeenDots& dots, const RigCamera& camera, std::size_t camera_index,
                   const CameraPrediction& prediction, const AssignmentGate& gate) noexcept;
  /// Appends the planets a camera should see.
  /// @return how many
  std::size_t predict_planets(const CameraPrediction& prediction, float magnitude_limit,
                              std::span<PredictedPoint> out) const noexcept;
  /// A planet and the dot it was assigned. @param entry  of the prediction
  void claim_planet(SeenDots& dots, std::size_t camera, std::uint16_t dot, std::uint16_t entry) noexcept {
    claim(dots, camera, dot, places_[entry - kFirstEntry]);
  }

  std::span<const Pairing> pairs() const noexcept { return pairs_; }

 private:
  void claim(SeenDots& dots, std::size_t camera, std::uint16_t dot, const SolarBodyPlace& place) noexcept;

  std::span<const SolarBodyPlace> places_;
  StaticVector<Pairing, limits::kSolarPairs> pairs_;
};

}  // namespace omma
