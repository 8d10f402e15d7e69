// How long the extractor's step may take, by what its cameras' dots are found with.
#pragma once

#include <chrono>
#include <span>

#include "components/extractor/camera_dots.hpp"

namespace omma {

/// Four times what was measured on one core of a desk machine for each algorithm, a pixel; docs/algorithms/
/// classical_extraction.md. @param threads  that share the cameras
std::chrono::nanoseconds extraction_budget(std::span<const ExtractorCamera> cameras, int threads);

}  // namespace omma
