// How a solved photograph is told: text for a person, JSON for a program, a picture for the eye.
#pragma once

#include <string>

#include "ground/solve/photograph_solver.hpp"

namespace omma::ground {

std::string solution_text(const Rig& rig, const PhotographSolution& solution, const DotLists& dots);

/// One JSON object; its members are listed in docs/solve.md.
std::string solution_json(const Rig& rig, const PhotographSolution& solution, const DotLists& dots);

/// Writes the image of one camera with its dots circled and its stars named.
void write_annotated(const std::string& file, const ImageView& image, const Rig& rig, std::size_t camera,
                     const PhotographSolution& solution, const DotLists& dots);

}  // namespace omma::ground
