// The screen of a terminal (ncurses): draws lines, notices the key that ends the program.
#pragma once

#include <vector>

#include "ground/monitor/monitor_table.hpp"

namespace omma::ground {

class Terminal {
 public:
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// What does not fit on the screen is left out at the bottom and at the right.
  void draw(const std::vector<TableLine>& lines);
  /// True when q was pressed since the last call.
  bool wants_to_leave();
};

}  // namespace omma::ground
