// Views of a calibration board: where its corners are on the board and in an image.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "hal/image.hpp"

namespace omma::ground {

struct BoardView {
  std::string name;                     ///< of the image
  std::vector<Eigen::Vector3d> points;  ///< on the board, in its unit
  std::vector<Eigen::Vector2d> pixels;  ///< in the image
};

/// A checkerboard, told by its inner corners.
struct Checkerboard {
  int columns = 0;
  int rows = 0;
  double square = 0;  ///< side of a square [m]
};

/// Finds the corners of a checkerboard to a fraction of a pixel (OpenCV: Duda & Frese 2018, BMVC; where that
/// finds none, the corners of Bouguet's toolbox, refined). None where the board is not seen whole.
std::optional<BoardView> find_checkerboard(const ImageView& image, const Checkerboard& board,
                                           const std::string& name);

/// Corners found before, as BabelCalib writes them: `.orpc` (board, corner, flag, u, v), each corner the
/// number of a line of the board's `.dsc` (tag, column, row, x, y, z) in any unit: a lens does not depend on
/// it.
/// @throws InputError (file, line, field, expected, found)
BoardView read_corners(const std::string& orpc, const std::string& board, int& width, int& height);

}  // namespace omma::ground
