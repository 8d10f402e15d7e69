// Holds a trajectory against the limits of its axis, over all times.
#pragma once

#include <string>
#include <vector>

#include "components/motion/axis.hpp"

namespace omma {

/// A sentence for each limit that the trajectory breaks: axis, time, value, limit; empty where it keeps all.
/// Start-up and ground only.
std::vector<std::string> broken_limits(const MotionAxis& axis);

}  // namespace omma
