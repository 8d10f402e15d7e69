// The wiring as a drawing (Graphviz DOT), made from the same declarations the program runs from.
#pragma once

#include <string>
#include <string_view>

#include "fsw/kernel/rate_group.hpp"

namespace omma {

/// One box per rate group with its components in order, one arrow per connection; crossings are dashed and
/// named by kind, feedback is dotted. Works on faulty wirings too: faults are listed as the drawing's label.
/// @param more  what else belongs into the drawing, in DOT
std::string wiring_graph(const RateGroupTable& table, std::string_view more = {});

}  // namespace omma
