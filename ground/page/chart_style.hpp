// How charts look, on a page and as pictures beside it: the colours by name, and rules for what a chart's SVG
// is made of.
#pragma once

#include <array>
#include <string_view>

namespace omma::ground {

struct PageColour {
  std::string_view name;  ///< as in var(--name)
  std::string_view light;
  std::string_view dark;
};

inline constexpr std::array<PageColour, 9> kPageColours{{{"ink", "#1b2430", "#e6ebf2"},
                                                         {"soft", "#667386", "#93a1b5"},
                                                         {"line", "#d9dfe7", "#2b3645"},
                                                         {"paper", "#fbfcfd", "#0f141b"},
                                                         {"card", "#ffffff", "#161d27"},
                                                         {"a", "#0b6bcb", "#6db3ff"},
                                                         {"b", "#c2570c", "#ffa75e"},
                                                         {"c", "#2e8b57", "#5cc98c"},
                                                         {"out", "#c81e3a", "#ff6b81"}}};

inline constexpr std::string_view kChartRules = R"(
svg .title{font:600 13px system-ui,sans-serif;fill:var(--ink)}svg .unit,svg .tick{font:11px system-ui,sans-serif;fill:var(--soft)}
svg .grid{stroke:var(--line)}svg .band{fill:var(--a);fill-opacity:.14}svg .in{fill:var(--a)}svg .out{fill:var(--out)}
svg .line{fill:none;stroke-width:1.6}svg .line.a{stroke:var(--a)}svg .line.b{stroke:var(--b)}svg .line.c{stroke:var(--c)}
svg .line.faint{stroke-dasharray:3 3;opacity:.75}svg .point{stroke:none}svg .label{font:11px system-ui,sans-serif}
svg .point.a,svg .label.a{fill:var(--a)}svg .point.b,svg .label.b{fill:var(--b)}svg .point.c,svg .label.c{fill:var(--c)}
)";

}  // namespace omma::ground
