// The graph of modes as a picture: a part of the program's own (`omma-fsw MISSION --graph`).
#pragma once

#include <span>
#include <string>

#include "fsw/services/mode_keeper.hpp"

namespace omma {

/// @return a subgraph of Graphviz DOT: solid by itself, with its guard; dashed by command
std::string mode_graph(std::span<const ModeTransition> transitions,
                       std::span<const ChannelDescriptor> channels);

}  // namespace omma
