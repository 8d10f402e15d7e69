// The adjustment of a lens to views of a board: lens and the board's pose in every view in one least squares,
// with the lens's covariance. Sources: Zhang 2000, PAMI 22 (many views of a plane); Triggs et al. 2000
// (adjustment).
#pragma once

#include <optional>
#include <vector>

#include "components/geometry/pose.hpp"
#include "ground/calibrate/board_view.hpp"
#include "ground/calibrate/lens_shape.hpp"

namespace omma::ground {

struct BoardAdjustment {
  bool converged = false;
  LensShape shape;
  std::vector<Pose> camera_from_board;                  ///< of each view
  double rms_px = 0;                                    ///< root mean square length of all residuals
  std::vector<std::vector<Eigen::Vector2d>> residuals;  ///< of each view, corner minus prediction [px]
  Eigen::MatrixXd lens_covariance;                      ///< for corners as good as the residuals say
};

/// Pose of a board seen through a lens, from its corners alone. None where it does not follow from them.
std::optional<Pose> board_pose(const BoardView& view, const Lens& lens);

/// @param fix_lens  the lens stays: only the poses are found (test views)
BoardAdjustment adjust_to_boards(const LensShape& start, const std::vector<BoardView>& views,
                                 const std::vector<Pose>& poses, bool fix_lens);

struct BoardCalibration {
  BoardAdjustment adjustment;
  std::string reason;  ///< why there is none; empty when there is one
};

/// Calibrates from nothing but the image's size: equidistant lenses of several fields of view are tried, the
/// best is adjusted as Kannala–Brandt, and that gives the start of the model asked for.
/// @param model  any of the three
BoardCalibration calibrate_from_boards(const std::vector<BoardView>& views, int width, int height,
                                       LensModel model);

}  // namespace omma::ground
