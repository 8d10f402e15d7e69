#include "fsw/services/mode_graph.hpp"

#include <cstdio>

namespace omma {
namespace {

std::string guard_text(const Condition& when, std::span<const ChannelDescriptor> channels) {
  if (when.channel == 0) return {};
  static constexpr const char* kSigns[] = {"<", ">", "="};
  std::string text;
  for (const ChannelDescriptor& channel : channels)
    if (channel.id == when.channel) text = channel.name;
  char rest[64];
  std::snprintf(rest, sizeof rest, " %s %g", kSigns[static_cast<std::size_t>(when.comparison)], when.value);
  text += rest;
  if (when.beats > 1) text += "\\n" + std::to_string(when.beats) + " beats";
  return text;
}

std::string name_of(int mode) {
  return std::string(choice_name(kModeNames, mode));
}

}  // namespace

std::string mode_graph(std::span<const ModeTransition> transitions,
                       std::span<const ChannelDescriptor> channels) {
  std::string dot = "  subgraph cluster_modes {\n    label=\"modes\";\n    node [shape=ellipse];\n";
  for (int mode = 0; mode < kModeCount; ++mode)
    dot += "    mode_" + name_of(mode) + " [label=\"" + name_of(mode) + "\"];\n";
  for (const ModeTransition& transition : transitions)
    for (int from = 0; from < kModeCount; ++from)
      if (contains(transition.from, static_cast<Mode>(from)))
        dot += "    mode_" + name_of(from) + " -> mode_" + name_of(static_cast<int>(transition.to)) +
               " [label=\"" + guard_text(transition.when, channels) + "\"" +
               (transition.commanded ? ", style=dashed" : "") + "];\n";
  return dot + "  }\n";
}

}  // namespace omma
