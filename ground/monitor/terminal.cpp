// ncurses by its C interface.
#include "ground/monitor/terminal.hpp"

#include <curses.h>

#include <clocale>

namespace omma::ground {
namespace {

enum ColourPair : short { kGreen = 1, kYellow, kRed, kCyan };

attr_t attributes(LineStyle style) {
  switch (style) {
    case LineStyle::kHeading:
      return A_BOLD | static_cast<attr_t>(COLOR_PAIR(kCyan));
    case LineStyle::kGood:
      return static_cast<attr_t>(COLOR_PAIR(kGreen));
    case LineStyle::kWarning:
      return static_cast<attr_t>(COLOR_PAIR(kYellow));
    case LineStyle::kBad:
      return A_BOLD | static_cast<attr_t>(COLOR_PAIR(kRed));
    case LineStyle::kStale:
      return A_DIM;
    case LineStyle::kPlain:
      break;
  }
  return A_NORMAL;
}

}  // namespace

Terminal::Terminal() {
  std::setlocale(LC_CTYPE, "");
  initscr();
  cbreak();
  noecho();
  curs_set(0);
  nodelay(stdscr, TRUE);
  if (!has_colors()) return;
  start_color();
  use_default_colors();
  init_pair(kGreen, COLOR_GREEN, -1);
  init_pair(kYellow, COLOR_YELLOW, -1);
  init_pair(kRed, COLOR_RED, -1);
  init_pair(kCyan, COLOR_CYAN, -1);
}

Terminal::~Terminal() {
  endwin();
}

void Terminal::draw(const std::vector<TableLine>& lines) {
  erase();
  const int rows = getmaxy(stdscr);
  const int columns = getmaxx(stdscr);
  for (std::size_t i = 0; i < lines.size() && static_cast<int>(i) < rows; ++i) {
    attrset(static_cast<int>(attributes(lines[i].style)));
    mvaddnstr(static_cast<int>(i), 0, lines[i].text.c_str(), columns);
  }
  attrset(A_NORMAL);
  refresh();
}

bool Terminal::wants_to_leave() {
  for (int key = getch(); key != ERR; key = getch())
    if (key == 'q' || key == 'Q') return true;
  return false;
}

}  // namespace omma::ground
