#include "ground/calibrate/board_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "components/estimation/pose_search.hpp"
#include "components/geometry/rig_dot.hpp"
#include "ground/calibrate/normal_equations.hpp"

namespace omma::ground {
namespace {

constexpr int kMostIterations = 200;
constexpr double kGuessedLensError = 0.02;  // of the image's width
constexpr double kNoModel = 3;              // a model this much worse than Kannala–Brandt …
constexpr double kNoModelPx = 0.5;          // … and this many pixels is none for the lens
constexpr double kNothing = 1e-6;           // squared residuals that no longer matter [px²]
constexpr double kFar = 1e4;                // residual of a corner the lens can not see [px]

class Adjuster {
 public:
  Adjuster(const LensShape& start, const std::vector<BoardView>& views, const std::vector<Pose>& poses,
           bool fix_lens)
      : views_(views), shape_(start), poses_(poses), fix_lens_(fix_lens) {}
  BoardAdjustment run();

 private:
  Eigen::Index lens_size() const { return shape_.parameters.size(); }
  Eigen::Index size() const { return lens_size() + 6 * static_cast<Eigen::Index>(views_.size()); }
  bool cost_of(const LensShape& shape, const std::vector<Pose>& poses, double& cost) const;
  bool sums_at(NormalEquations& sums) const;
  void add_corner(const Lens& lens, const std::vector<std::pair<Lens, Lens>>& moved,
                  const Eigen::VectorXd& steps, std::size_t view, std::size_t corner,
                  NormalEquations& sums) const;
  void take(const Eigen::VectorXd& step, LensShape& shape, std::vector<Pose>& poses) const;
  void finish(BoardAdjustment& result) const;

  const std::vector<BoardView>& views_;
  LensShape shape_;
  std::vector<Pose> poses_;
  bool fix_lens_;
};

Eigen::Vector2d residual_of(const Lens& lens, const Pose& pose, const Eigen::Vector3d& point,
                            const Eigen::Vector2d& pixel) {
  Eigen::Vector2d predicted = Eigen::Vector2d::Constant(-kFar);
  lens.project(pose * point, predicted);
  return pixel - predicted;
}

bool Adjuster::cost_of(const LensShape& shape, const std::vector<Pose>& poses, double& cost) const {
  const std::optional<Lens> lens = shape.lens();
  if (!lens) return false;
  cost = 0;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    for (std::size_t k = 0; k < views_[v].points.size(); ++k)
      cost += residual_of(*lens, poses[v], views_[v].points[k], views_[v].pixels[k]).squaredNorm();
  }
  return std::isfinite(cost);
}

void Adjuster::add_corner(const Lens& lens, const std::vector<std::pair<Lens, Lens>>& moved,
                          const Eigen::VectorXd& steps, std::size_t view, std::size_t corner,
                          NormalEquations& sums) const {
  const Pose& pose = poses_[view];
  const Eigen::Vector3d turned = pose.rotation * views_[view].points[corner];
  const Eigen::Vector3d direction = turned + pose.translation;
  Eigen::Vector2d pixel = Eigen::Vector2d::Constant(-kFar);
  Eigen::Matrix<double, 2, 3> by_direction = Eigen::Matrix<double, 2, 3>::Zero();
  lens.project(direction, pixel, by_direction);
  const Eigen::Vector2d residual = views_[view].pixels[corner] - pixel;
  const Eigen::Index n = lens_size();
  Eigen::MatrixXd jacobian(2, n + 6);
  jacobian.leftCols(n).setZero();
  for (Eigen::Index k = 0; k < n && !fix_lens_; ++k) {
    Eigen::Vector2d up = pixel;
    Eigen::Vector2d down = pixel;
    moved[static_cast<std::size_t>(k)].first.project(direction, up);
    moved[static_cast<std::size_t>(k)].second.project(direction, down);
    jacobian.col(k) = (up - down) / (2 * steps[k]);
  }
  jacobian.middleCols<3>(n) = -by_direction * skew(turned);
  jacobian.rightCols<3>() = by_direction;
  const Eigen::Index at = n + 6 * static_cast<Eigen::Index>(view);
  sums.cost += residual.squaredNorm();
  sums.gradient.head(n) += jacobian.leftCols(n).transpose() * residual;
  sums.gradient.segment<6>(at) += jacobian.rightCols<6>().transpose() * residual;
  sums.information.topLeftCorner(n, n) += jacobian.leftCols(n).transpose() * jacobian.leftCols(n);
  const Eigen::MatrixXd cross = jacobian.leftCols(n).transpose() * jacobian.rightCols<6>();
  sums.information.block(0, at, n, 6) += cross;
  sums.information.block(at, 0, 6, n) += cross.transpose();
  sums.information.block<6, 6>(at, at) += jacobian.rightCols<6>().transpose() * jacobian.rightCols<6>();
}

bool Adjuster::sums_at(NormalEquations& sums) const {
  const std::optional<Lens> lens = shape_.lens();
  if (!lens) return false;
  const Eigen::VectorXd steps = shape_.steps();
  std::vector<std::pair<Lens, Lens>> moved;
  for (Eigen::Index k = 0; k < steps.size(); ++k) {
    LensShape up = shape_;
    LensShape down = shape_;
    up.parameters[k] += steps[k];
    down.parameters[k] -= steps[k];
    moved.emplace_back(up.lens().value_or(*lens), down.lens().value_or(*lens));
  }
  sums.information = Eigen::MatrixXd::Zero(size(), size());
  sums.gradient = Eigen::VectorXd::Zero(size());
  sums.cost = 0;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    for (std::size_t k = 0; k < views_[v].points.size(); ++k) add_corner(*lens, moved, steps, v, k, sums);
  }
  if (fix_lens_) sums.information.topLeftCorner(lens_size(), lens_size()).setIdentity();
  return true;
}

void Adjuster::take(const Eigen::VectorXd& step, LensShape& shape, std::vector<Pose>& poses) const {
  shape.parameters += step.head(lens_size());
  for (std::size_t v = 0; v < poses.size(); ++v) {
    const Vector6d s = step.segment<6>(lens_size() + 6 * static_cast<Eigen::Index>(v));
    poses[v].rotation = (rotation_exp(s.head<3>()) * poses[v].rotation).normalized();
    poses[v].translation += s.tail<3>();
  }
}

void Adjuster::finish(BoardAdjustment& result) const {
  const Lens lens = shape_.lens().value();
  double sum = 0;
  double count = 0;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    result.residuals.emplace_back();
    for (std::size_t k = 0; k < views_[v].points.size(); ++k) {
      result.residuals[v].push_back(residual_of(lens, poses_[v], views_[v].points[k], views_[v].pixels[k]));
      sum += result.residuals[v].back().squaredNorm();
      ++count;
    }
  }
  result.rms_px = std::sqrt(sum / count);
  result.shape = shape_;
  result.camera_from_board = poses_;
  NormalEquations sums;
  if (fix_lens_ || !sums_at(sums)) return;
  const double variance = sum / std::max(1.0, 2 * count - double(size()));
  Eigen::VectorXd unused;
  Eigen::MatrixXd covariance;
  if (!solve_scaled(sums, 0, unused, &covariance)) return;
  result.lens_covariance = variance * covariance.topLeftCorner(lens_size(), lens_size());
}

BoardAdjustment Adjuster::run() {
  BoardAdjustment result;
  NormalEquations here;
  if (!sums_at(here)) return result;
  double damping = 1e-4;
  for (int iteration = 0; iteration < kMostIterations && !result.converged; ++iteration) {
    Eigen::VectorXd step;
    if (!solve_scaled(here, damping, step, nullptr)) {
      damping *= 10;
      if (damping > 1e8) break;
      continue;
    }
    LensShape shape = shape_;
    std::vector<Pose> poses = poses_;
    take(step, shape, poses);
    double cost = 0;
    if (cost_of(shape, poses, cost) && cost <= here.cost) {
      result.converged = here.cost - cost < 1e-8 * here.cost + kNothing && damping < 1e-2;
      shape_ = shape;
      poses_ = poses;
      if (!sums_at(here)) return result;
      damping = std::max(1e-12, 0.1 * damping);
    } else {
      damping *= 8;
      result.converged = damping > 1e8;  // no step lowers the cost: numerically at the minimum
    }
  }
  finish(result);
  return result;
}

// Root mean square over the views whose pose follows, and those poses; views without one count as far off.
double rms_with(const LensShape& shape, const std::vector<BoardView>& views, std::vector<Pose>& poses) {
  const std::optional<Lens> lens = shape.lens();
  if (!lens) return kFar;
  poses.assign(views.size(), Pose{});
  double sum = 0;
  double count = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const std::optional<Pose> pose = board_pose(views[v], *lens);
    if (pose) poses[v] = *pose;
    for (std::size_t k = 0; k < views[v].points.size(); ++k) {
      const double squared =
          pose ? residual_of(*lens, *pose, views[v].points[k], views[v].pixels[k]).squaredNorm() : 1e6;
      sum += std::min(squared, 1e6);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

std::optional<Pose> board_pose(const BoardView& view, const Lens& lens) {
  RigCamera camera;
  camera.lens = lens;
  std::vector<Sight> sights;
  // The solver's reach is limited: a spread of corners over the board is enough for a start.
  const std::size_t stride = view.points.size() / 60 + 1;
  for (std::size_t k = 0; k < view.points.size(); k += stride) {
    Dot dot;
    dot.pixel = view.pixels[k];
    // The lens may be a mere guess: corners are allowed to be far from where it puts them.
    const double off = kGuessedLensError * lens.width();
    dot.covariance = off * off * Eigen::Matrix2d::Identity();
    RigDot seen;
    if (!rig_dot(dot, 0, camera, 0, 0, seen)) continue;
    sights.push_back({seen.origin, seen.ray, seen.whitener, view.points[k]});
  }
  if (sights.size() < 4) return std::nullopt;
  SolveOptions options;
  options.cull = CullRule::kNone;
  options.inconsistent_scale = 1e6;
  options.largest_position_sigma = 1e3;
  options.largest_rotation_sigma = 10;
  const PoseSolution solution = find_pose(sights, options, {});
  if (solution.status != SolveStatus::kSolved && solution.status != SolveStatus::kIterationCap)
    return std::nullopt;
  return solution.rig_from_body;
}

BoardAdjustment adjust_to_boards(const LensShape& start, const std::vector<BoardView>& views,
                                 const std::vector<Pose>& poses, bool fix_lens) {
  return Adjuster(start, views, poses, fix_lens).run();
}

BoardCalibration calibrate_from_boards(const std::vector<BoardView>& views, int width, int height,
                                       LensModel model) {
  BoardCalibration calibration;
  LensShape best;
  std::vector<Pose> best_poses;
  double best_rms = kFar;
  for (int k = 0; k < 20; ++k) {
    const double fov_deg = 25 * std::pow(1.12, k);  // to 215 degrees
    const double half = 0.5 * fov_deg * M_PI / 180;
    const LensShape shape = equidistant_shape(width, height, 0.5 * std::max(width, height) / half, 3.1);
    std::vector<Pose> poses;
    const double rms = rms_with(shape, views, poses);
    if (rms >= best_rms) continue;
    best_rms = rms;
    best = shape;
    best_poses = poses;
  }
  if (best_rms > 0.2 * width) {
    calibration.reason =
        "no field of view from 25 to 215 degrees explains the corners; is the board's size right?";
    return calibration;
  }
  calibration.adjustment = adjust_to_boards(best, views, best_poses, false);
  if (model != LensModel::kKannalaBrandt && calibration.adjustment.converged) {
    const double before = calibration.adjustment.rms_px;
    const LensShape next = nearest_shape(calibration.adjustment.shape.lens().value(), model, 3.0);
    calibration.adjustment = adjust_to_boards(next, views, calibration.adjustment.camera_from_board, false);
    if (calibration.adjustment.rms_px > kNoModel * before + kNoModelPx)
      calibration.reason = "the model asked for can not describe this lens (kb4 can)";
  }
  if (calibration.reason.empty() && !calibration.adjustment.converged)
    calibration.reason = "the adjustment did not converge: too few or too like views";
  return calibration;
}

}  // namespace omma::ground
