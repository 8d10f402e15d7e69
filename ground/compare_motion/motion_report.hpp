// What the comparison of two motions found, as text, JSON and a page.
#pragma once

#include <string>

#include "ground/compare_motion/motion_match.hpp"

namespace omma::ground {

struct MotionReport {
  std::string measured;
  std::string truth;
  bool rotations = false;
  MatchOptions options;
  MotionMatch match;
};

std::string motion_text(const MotionReport& report);
std::string motion_json(const MotionReport& report);
std::string motion_page(const MotionReport& report);

}  // namespace omma::ground
