// The rigid motion that takes one set of points nearest to another.
// Source: Arun, Huang & Blostein, "Least-squares fitting of two 3-D point sets", PAMI 9 (1987); the
// determinant's sign after Umeyama, PAMI 13 (1991).
#pragma once

#include <span>

#include "components/geometry/pose.hpp"

namespace omma {

/// Minimises Σ |pose · from − to|². Sets of equal length, at least three points not in line.
Pose absolute_orientation(std::span<const Eigen::Vector3d> from,
                          std::span<const Eigen::Vector3d> to) noexcept;

}  // namespace omma
