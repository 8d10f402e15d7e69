// Axes and shims as text, JSON and a page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ground/calibrate/axis_shims.hpp"

namespace omma::ground {

struct AxisReport {
  std::vector<NamedAxis> axes;
  std::optional<AxisShims> shims;  ///< nothing where there is one axis alone
  std::optional<std::size_t> keep;
};

std::string axis_text(const AxisReport& report);
std::string axis_json(const AxisReport& report);
std::string axis_page(const AxisReport& report);

}  // namespace omma::ground
