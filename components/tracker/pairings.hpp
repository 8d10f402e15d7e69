// Pairings: dots ↔ stars and dots ↔ targets of one frame set, all cameras together.
#pragma once

#include <cstdint>
#include <optional>

#include "components/catalogue/apparent_place.hpp"
#include "components/estimation/sight.hpp"
#include "components/geometry/pose.hpp"
#include "config/limits.hpp"
#include "config/sky_limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

struct Pairing {
  Sight sight;
  std::uint8_t camera = 0;        ///< index in the rig
  std::uint16_t dot = 0;          ///< index in the camera's DotList
  std::uint16_t entry = 0;        ///< star: HR number; target: index in the body; else a SolarBody
  std::uint32_t persistence = 0;  ///< frame sets this pairing has lasted without a gap
  TimeNs since_ns = 0;            ///< exposure midpoint of the first of them
};

enum class TrackState : std::uint8_t { kLost, kAcquired, kTracking };

struct SkyPairings {
  TrackState state = TrackState::kLost;
  Eigen::Quaterniond rig_from_j2000 =
      Eigen::Quaterniond::Identity();  ///< predicted or acquired: where the solver starts
  /// What the observer's own place adds to directions seen from the centre of the Earth; none: it is not
  /// known.
  std::optional<ApparentPlace> from_here;
  StaticVector<Pairing, limits::kStarPairs> pairs;
  /// Dots of Sun, Moon and planets; not for the attitude (discs have phases). Several dots may be of one
  /// disc.
  StaticVector<Pairing, limits::kSolarPairs> solar;
};

struct BodyPairings {
  TrackState state = TrackState::kLost;
  std::uint8_t body = 0;  ///< index in the mission
  Pose rig_from_body;     ///< predicted or acquired: where the solver starts
  StaticVector<Pairing, limits::kTargetPairs> pairs;
};

struct Pairings {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;
  SkyPairings sky;
  StaticVector<BodyPairings, limits::kTargetBodies> bodies;
  std::uint32_t unclaimed_dots = 0;  ///< dots that neither the sky nor a body explains
};

}  // namespace omma
