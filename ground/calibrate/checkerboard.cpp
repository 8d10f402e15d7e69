// Corners of a checkerboard, by OpenCV.
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "ground/calibrate/board_view.hpp"

namespace omma::ground {
namespace {

cv::Mat grey_of(const ImageView& image) {
  cv::Mat grey(image.height, image.width, CV_8UC1);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      grey.at<std::uint8_t>(v, u) =
          image.format == PixelFormat::kGrey8
              ? image.row<std::uint8_t>(v)[u]
              : static_cast<std::uint8_t>(image.row<std::uint16_t>(v)[u] * 255.0 / image.white_level);
    }
  }
  return grey;
}

// Half the shortest distance of neighbouring corners, so that the window holds one corner alone.
int window_of(const std::vector<cv::Point2f>& corners, const Checkerboard& board) {
  double shortest = 1e9;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column + 1 < board.columns; ++column) {
      const auto i = static_cast<std::size_t>(row * board.columns + column);
      shortest = std::min(shortest, std::hypot(double(corners[i].x - corners[i + 1].x),
                                               double(corners[i].y - corners[i + 1].y)));
    }
  }
  return std::clamp(static_cast<int>(0.4 * shortest), 2, 11);
}

}  // namespace

std::optional<BoardView> find_checkerboard(const ImageView& image, const Checkerboard& board,
                                           const std::string& name) {
  const cv::Mat grey = grey_of(image);
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  bool found =
      cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY);
  if (!found) {
    found = cv::findChessboardCorners(grey, size, corners,
                                      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE);
    if (!found) return std::nullopt;
    const int half = window_of(corners, board);
    cv::cornerSubPix(grey, corners, cv::Size(half, half), cv::Size(-1, -1),
                     cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 60, 1e-4));
  }
  BoardView view;
  view.name = name;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const cv::Point2f& corner = corners[static_cast<std::size_t>(row * board.columns + column)];
      view.points.emplace_back(column * board.square, row * board.square, 0);
      view.pixels.emplace_back(corner.x, corner.y);
    }
  }
  return view;
}

}  // namespace omma::ground
