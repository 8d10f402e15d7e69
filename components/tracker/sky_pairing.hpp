// Pairs dots with stars when the attitude is roughly known: catalogue projected, gated, assigned one to one.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <span>

#include "components/catalogue/apparent_place.hpp"
#include "components/catalogue/star.hpp"
#include "components/geometry/rig.hpp"
#include "components/tracker/assignment.hpp"
#include "components/tracker/camera_prediction.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"
#include "components/tracker/solar_pairing.hpp"

namespace omma {

class SkyPairing {
 public:
  /// Sun, Moon and planets to look for among the stars; as SolarPairing::look_for.
  void look_for(std::span<const SolarBodyPlace> places) noexcept { solar_.look_for(places); }

  /// From where: what is added to the directions of the stars. @param here  nullptr: nothing; else outlives
  /// this
  void look_from(const ApparentPlace* here) noexcept { here_ = here; }

  /// Appends the pairs of all cameras to `out`, camera by camera, and marks their dots as claimed. Of each
  /// image the brightest Assigner::kPredictions stars are looked for. Where the cameras have more pairs than
  /// `out` has room for, each gets the same share of it, its brightest stars.
  /// @param stars  seen from the centre of the Earth, brightest first; those fainter than `magnitude_limit`
  /// are not used
  void pair(SeenDots& dots, const Rig& rig, std::span<const SkyStar> stars,
            const PredictedAttitude& prediction, float magnitude_limit, const AssignmentGate& gate,
            std::span<const HiddenCone> hidden, StaticVector<Pairing, limits::kStarPairs>& out) noexcept;

  /// Of Sun, Moon and planets, from the last call; their dots are claimed as well.
  std::span<const Pairing> solar_pairs() const noexcept { return solar_.pairs(); }

  /// Pairs the last call would have made, in the mean, of dots at random.
  double chance() const { return chance_; }

 private:
  struct Found {
    std::uint16_t star;  // index in the catalogue, brightest first
    std::uint16_t dot;
  };
  using FoundStars = StaticVector<Found, limits::kDotsPerCamera>;

  void predict(const CameraPrediction& prediction, std::span<const SkyStar> stars,
               float magnitude_limit) noexcept;
  bool seen(const SkyStar& star, Eigen::Vector3d& direction) const noexcept;
  void drop_too_bright(std::span<const SkyStar> stars, const DotList& list, FoundStars& found) noexcept;
  std::size_t share_of_each(std::size_t cameras, std::size_t room) const noexcept;

  StaticVector<PredictedPoint, Assigner::kPredictions> points_;
  std::array<FoundStars, limits::kCameras> found_;
  // Grey levels of each pair's dot a unit of its star's light.
  StaticVector<float, limits::kDotsPerCamera> per_star_light_;
  Assigner assigner_;
  SolarPairing solar_;
  const ApparentPlace* here_ = nullptr;
  double chance_ = 0;
};

}  // namespace omma
