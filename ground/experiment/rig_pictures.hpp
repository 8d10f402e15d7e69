// One frame of each camera of a run, with what its dots were taken for, for the page of an experiment.
#pragma once

#include <string>
#include <vector>

#include "ground/experiment/chain.hpp"

namespace omma::ground {

struct RigPicture {
  std::string camera;
  std::vector<std::uint8_t> png;
};

/// Of the frame set in the middle of those whose dots the log has; empty where there is none.
std::vector<RigPicture> rig_pictures(const ChainRun& run);

}  // namespace omma::ground
