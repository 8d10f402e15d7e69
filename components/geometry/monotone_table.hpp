// A growing function of one variable on equal steps, with its slopes: cubic Hermite in between. The lens
// models start their Newton iterations from it, so that one or two steps are enough.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace omma {

class MonotoneTable {
 public:
  static constexpr int kIntervals = 64;

  MonotoneTable() = default;

  /// @param end       the table covers [0, end], end > 0
  /// @param function  called as function(x, value, slope) for each node, x rising from 0 to end
  template <class Function>
  MonotoneTable(double end, Function&& function) : end_(end), nodes_per_unit_(kIntervals / end) {
    for (int i = 0; i <= kIntervals; ++i) {
      double slope = 0;
      Node& node = nodes_[static_cast<std::size_t>(i)];
      function(end * i / kIntervals, node.value, slope);
      node.slope = slope * end / kIntervals;
    }
  }

  double end() const noexcept { return end_; }

  /// Value at x; x outside [0, end] is taken as the nearer end.
  double operator()(double x) const noexcept {
    const double position = std::clamp(x * nodes_per_unit_, 0.0, static_cast<double>(kIntervals));
    const int i = std::min(static_cast<int>(position), kIntervals - 1);
    const double t = position - i;
    const Node& a = nodes_[static_cast<std::size_t>(i)];
    const Node& b = nodes_[static_cast<std::size_t>(i) + 1];
    const double rise = b.value - a.value;
    return a.value +
           t * (a.slope + t * ((3 * rise - 2 * a.slope - b.slope) + t * (a.slope + b.slope - 2 * rise)));
  }

 private:
  struct Node {
    double value = 0;
    double slope = 0;  ///< per interval, not per unit of x
  };
  std::array<Node, kIntervals + 1> nodes_{};
  double end_ = 0;
  double nodes_per_unit_ = 0;
};

}  // namespace omma
