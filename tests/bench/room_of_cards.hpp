// A rig among cards on the walls of a room, turned from frame set to frame set: sights of the cards with
// noise, and the truth. For the calibration of rigs.
#pragma once

#include <cstdint>

#include "ground/calibrate/rig_calibration.hpp"

namespace omma {

struct RoomOfCards {
  Rig rig;  ///< as it is
  ground::RigGeometry truth;
  std::vector<ground::BodyView> views;
  int bodies = 0;
};

/// @param rig    as it is
/// @param sets   frame sets, each with the rig turned at random and shifted by up to 0.2 m
/// @param noise  deviation of a dot per axis [px]
RoomOfCards room_of_cards(const Rig& rig, int sets, double noise, std::uint64_t seed);

}  // namespace omma
