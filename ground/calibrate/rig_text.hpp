// A rig file as text.
#pragma once

#include <string>
#include <vector>

#include "components/geometry/rig.hpp"

namespace omma::ground {

/// @param made_by     written as a comment
/// @param lens_files  one a camera
std::string rig_file_text(const Rig& rig, const std::vector<std::string>& lens_files,
                          const std::string& made_by);

}  // namespace omma::ground
