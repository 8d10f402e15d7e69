// What can be chosen about approaches.
#pragma once

#include <array>

#include "components/approach/range_filter.hpp"
#include "components/approach/range_mode.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

/// A body whose light is followed.
struct FollowedBody {
  std::uint8_t body = 0;  ///< index in the mission
  RangeFilterParameters range;
};

struct ApproachParameters {
  StaticVector<FollowedBody, limits::kTargetBodies> bodies;
  RangeModeParameters modes;
  /// Of each camera [electrons a grey level]; 0: its grey levels are not even in light, or are evened out
  /// after the frame: only dots are looked at.
  std::array<double, limits::kCameras> gain{};
  std::array<double, limits::kCameras> black_level{};  ///< of no light, of each camera [grey levels]
  double bearing_acceleration = 2e-4;                  ///< of a light's direction, not modelled [rad/s²]
  double largest_rate = 0.05;                          ///< of a light against the stars [rad/s]
  double largest_sigma = 0.02;                         ///< a light known worse than this is lost [rad]
  int patience = 20;                                   ///< frame sets in a row a light may be missed
  int candidates = 4;                                  ///< lights followed at once until one is chosen
};

}  // namespace omma
