// The extraction pipelines side by side as one picture: a row of panels for each kind of frame, a column for
// each algorithm, with what each found (green), missed (yellow) and made up (red).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "hal/image.hpp"

namespace omma {

enum class PanelMark { kFound, kMissed, kFalse };

struct MarkedPlace {
  Eigen::Vector2d pixel;
  PanelMark mark;
};

struct Panel {
  int row = 0, column = 0;
  std::string title;
  std::vector<MarkedPlace> places;
};

class PipelinePicture {
 public:
  PipelinePicture(int rows, int columns) : rows_(rows), columns_(columns) {}

  /// Shows the part of the image about `middle` in a panel.
  void put(const Panel& panel, const ImageView& image, const Eigen::Vector2d& middle);
  /// @throws std::runtime_error naming the path when it cannot be written
  void write(const std::string& path) const;

 private:
  struct Filled {
    Panel panel;
    std::vector<std::uint8_t> pixels;
    Eigen::Vector2d corner;
  };

  int rows_, columns_;
  std::vector<Filled> panels_;
};

}  // namespace omma
