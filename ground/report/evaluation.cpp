#include "ground/report/evaluation.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "fsw/kernel/input_error.hpp"
#include "ground/report/exposure_shift.hpp"

namespace omma::ground {
namespace {

using Dots = std::vector<std::vector<omma_Dot>>;  // by camera

Eigen::Quaterniond quaternion(const omma_Quaternion& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

/// The spots of a frame set by who they are: what a dot's role, body and entry name.
class SpotsByName {
 public:
  SpotsByName(const TruthFrame& frame, const std::vector<TargetBody>& bodies) {
    for (const TruthSpot& spot : frame.spots) {
      if (spot.kind == TruthSpot::Kind::kStar)
        spots_[{spot.camera, omma_DOT_STAR, 0, spot.hr}] = &spot;
      else if (spot.kind == TruthSpot::Kind::kTarget)
        add_target(spot, bodies);
    }
  }
  const TruthSpot* of(int camera, const omma_Dot& dot) const {
    const int body = dot.role == omma_DOT_TARGET ? dot.body : 0;
    const auto at = spots_.find({camera, dot.role, body, dot.entry});
    return at == spots_.end() ? nullptr : at->second;
  }

 private:
  void add_target(const TruthSpot& spot, const std::vector<TargetBody>& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies[b].name.view() != spot.body) continue;
      for (std::size_t i = 0; i < bodies[b].targets.size(); ++i)
        if (bodies[b].targets[i].id.view() == spot.id)
          spots_[{spot.camera, omma_DOT_TARGET, static_cast<int>(b), static_cast<int>(i)}] = &spot;
    }
  }
  std::map<std::tuple<int, int, int, int>, const TruthSpot*> spots_;
};

bool used(const omma_Dot& dot) {
  return (dot.role == omma_DOT_STAR || dot.role == omma_DOT_TARGET) && !dot.culled;
}

/// The spots that the solutions of this frame set were made of.
std::vector<TruthSpot> used_spots(const Dots& dots, const SpotsByName& names) {
  std::vector<TruthSpot> spots;
  for (std::size_t camera = 0; camera < dots.size(); ++camera)
    for (const omma_Dot& dot : dots[camera])
      if (const TruthSpot* spot = used(dot) ? names.of(static_cast<int>(camera), dot) : nullptr)
        spots.push_back(*spot);
  return spots;
}

void check_pairs(const Dots& dots, const SpotsByName& names, PairCheck& check) {
  for (std::size_t camera = 0; camera < dots.size(); ++camera) {
    for (const omma_Dot& dot : dots[camera]) {
      if (!used(dot)) continue;
      const TruthSpot* spot = names.of(static_cast<int>(camera), dot);
      if (spot == nullptr) {
        ++check.unknown;
      } else {
        const double off = std::hypot(spot->pixel.x() - dot.u_px, spot->pixel.y() - dot.v_px);
        ++(off <= kLargestOffsetPx ? check.right : check.wrong);
      }
    }
  }
}

template <class Matrix>
auto sigmas_of_bound(const Matrix& information) {
  Matrix covariance;
  Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> sigmas;
  if (bound_of(information, covariance)) {
    sigmas = covariance.diagonal().cwiseSqrt();
  } else {
    sigmas.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return sigmas;
}

/// What one frame set is judged by.
struct Judge {
  const FlownMission& mission;
  const TruthFrame& truth;
  double time;
  SpotChoice counts;
  std::vector<TruthSpot> used;
  BoundFrom bound;
};

AttitudeError attitude_error(const Judge& judge, const omma_Attitude& sample) {
  static const SpotChoice kAll = [](const TruthSpot&) { return true; };
  AttitudeError point;
  point.frame = sample.frame;
  point.time = judge.time;
  point.error = rotation_log(judge.truth.rig_from_j2000 * quaternion(sample.rig_from_j2000).conjugate());
  const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(sample.covariance_rad2);
  point.sigma = covariance.diagonal().cwiseSqrt();
  point.nees = squared_in_sigmas<3>(point.error, covariance);
  point.shift = attitude_shift(judge.mission.rig, judge.truth, judge.used);
  point.rest_nees = squared_in_sigmas<3>(point.error - point.shift, covariance);
  point.bound =
      judge.bound == BoundFrom::kEstimate
          ? point.sigma
          : sigmas_of_bound(attitude_information(judge.mission.rig, judge.truth.spots, judge.counts));
  point.used_bound = sigmas_of_bound(attitude_information(judge.mission.rig, judge.used, kAll));
  return point;
}

void check_protection(const Eigen::Vector3d& error, const omma_Vector3& level, ProtectionCheck& check) {
  const Eigen::Vector3d levels(level.x, level.y, level.z);
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(levels[k])) continue;
    ++check.axes;
    check.beyond += std::abs(error[k]) > levels[k] ? 1 : 0;
  }
}

PoseError pose_error(const Judge& judge, const TargetBody& body, std::size_t truth_index,
                     const omma_RelativePose& sample) {
  const Pose& rig_from_body = judge.truth.bodies[truth_index].rig_from_body;
  static const SpotChoice kAll = [](const TruthSpot&) { return true; };
  PoseError point;
  point.frame = sample.frame;
  point.time = judge.time;
  point.range = rig_from_body.translation.norm();
  const Eigen::Vector3d position(sample.position_m.x, sample.position_m.y, sample.position_m.z);
  point.error << rotation_log(rig_from_body.rotation * quaternion(sample.rig_from_body).conjugate()),
      rig_from_body.translation - position;
  const Matrix6d covariance = Eigen::Map<const Matrix6d>(sample.covariance);
  point.sigma = covariance.diagonal().cwiseSqrt();
  point.nees = squared_in_sigmas<6>(point.error, covariance);
  const Rig& rig = judge.mission.rig;
  point.shift = pose_shift(rig, judge.truth, judge.used, body, truth_index);
  point.rest_nees = squared_in_sigmas<6>(point.error - point.shift, covariance);
  point.bound =
      judge.bound == BoundFrom::kEstimate
          ? point.sigma
          : sigmas_of_bound(pose_information(rig, judge.truth.spots, body, rig_from_body, judge.counts));
  point.used_bound = sigmas_of_bound(pose_information(rig, judge.used, body, rig_from_body, kAll));
  return point;
}

const Pose* pose_of(const TruthFrame& frame, const std::string& body) {
  for (const TruthBody& one : frame.bodies)
    if (one.name == body) return &one.rig_from_body;
  return nullptr;
}

/// @param first  the true pose of the frame set that the sample's motion is referred to
PoseError motion_error(const Judge& judge, const Pose& first, const Pose& now,
                       const omma_RelativePose& sample) {
  PoseError point;
  point.frame = sample.frame;
  point.time = judge.time;
  point.range = now.translation.norm();
  const Eigen::Quaterniond turned = now.rotation * first.rotation.conjugate();
  const Eigen::Vector3d moved(sample.motion_m.x, sample.motion_m.y, sample.motion_m.z);
  point.error << rotation_log(turned * quaternion(sample.motion).conjugate()),
      now.translation - first.translation - moved;
  const Matrix6d covariance = Eigen::Map<const Matrix6d>(sample.motion_covariance);
  point.sigma = covariance.diagonal().cwiseSqrt();
  point.nees = squared_in_sigmas<6>(point.error, covariance);
  return point;
}

/// √ of the mean of the squares of `of(point)` over the points where it is a number.
template <class Points, class Of>
auto rms_over(const Points& points, Of&& of) {
  using Vector = std::decay_t<decltype(of(points.front()))>;
  Vector sum = Vector::Zero();
  double count = 0;
  for (const auto& point : points) {
    const Vector value = of(point);
    if (!value.allFinite()) continue;
    sum += value.cwiseAbs2();
    ++count;
  }
  return Vector((sum / std::max(count, 1.0)).cwiseSqrt());
}

template <class Points, class Point>
std::vector<double> nees_of(const Points& points, double Point::*nees) {
  std::vector<double> samples;
  samples.reserve(points.size());
  for (const Point& point : points) samples.push_back(point.*nees);
  return samples;
}

void sum_up(AttitudeEvaluation& evaluation) {
  const auto& points = evaluation.points;
  if (points.empty()) return;
  evaluation.rms = rms_over(points, [](const AttitudeError& p) { return p.error; });
  evaluation.bound_rms = rms_over(points, [](const AttitudeError& p) { return p.bound; });
  evaluation.used_bound_rms = rms_over(points, [](const AttitudeError& p) { return p.used_bound; });
  evaluation.nees = mean_nees(nees_of(points, &AttitudeError::nees), 3);
  evaluation.shift_rms = rms_over(points, [](const AttitudeError& p) { return p.shift; });
  evaluation.rest_rms =
      rms_over(points, [](const AttitudeError& p) { return Eigen::Vector3d(p.error - p.shift); });
  evaluation.rest_nees = mean_nees(nees_of(points, &AttitudeError::rest_nees), 3);
}

void sum_up(PoseEvaluation& evaluation) {
  const auto& points = evaluation.points;
  if (points.empty()) return;
  evaluation.rms = rms_over(points, [](const PoseError& p) { return p.error; });
  evaluation.bound_rms = rms_over(points, [](const PoseError& p) { return p.bound; });
  const auto lengths = [&](auto of) {  // of rotation and of position over range
    const Vector6d each = rms_over(points, [&](const PoseError& p) {
      Vector6d value = of(p);
      value.template tail<3>() /= p.range;
      return value;
    });
    return Eigen::Vector2d(each.head<3>().norm(), each.tail<3>().norm());
  };
  const Eigen::Vector2d rms = lengths([](const PoseError& p) { return p.error; });
  const Eigen::Vector2d bound = lengths([](const PoseError& p) { return p.bound; });
  const Eigen::Vector2d used_bound = lengths([](const PoseError& p) { return p.used_bound; });
  evaluation.rotation = {rms[0], bound[0], used_bound[0]};
  evaluation.position_part = {rms[1], bound[1], used_bound[1]};
  evaluation.nees = mean_nees(nees_of(points, &PoseError::nees), 6);
  evaluation.shift_rms = rms_over(points, [](const PoseError& p) { return p.shift; });
  evaluation.rest_rms = rms_over(points, [](const PoseError& p) { return Vector6d(p.error - p.shift); });
  evaluation.rest_nees = mean_nees(nees_of(points, &PoseError::rest_nees), 6);
}

void sum_up(MotionEvaluation& evaluation) {
  if (evaluation.points.empty()) return;
  evaluation.rms = rms_over(evaluation.points, [](const PoseError& p) { return p.error; });
  evaluation.mean_nees = mean_nees(nees_of(evaluation.points, &PoseError::nees), 6).mean;
}

std::vector<PoseEvaluation> bodies_to_judge(const FlownMission& mission,
                                            const std::vector<TruthFrame>& truth) {
  std::vector<PoseEvaluation> poses(mission.bodies.size());
  for (std::size_t b = 0; b < poses.size(); ++b) {
    poses[b].body = mission.bodies[b].name.view();
    for (const TruthFrame& frame : truth) {
      for (const TruthBody& body : frame.bodies) {
        if (body.name != poses[b].body) continue;
        poses[b].last_range = body.rig_from_body.translation.norm();
        if (poses[b].frames++ == 0) poses[b].first_range = poses[b].last_range;
      }
    }
  }
  return poses;
}

SpotCount count_spots(const TruthFrame& frame, double time, const SpotChoice& counts, const Dots& dots) {
  SpotCount count;
  count.time = time;
  for (const TruthSpot& spot : frame.spots) {
    if (!counts(spot)) continue;
    if (spot.kind == TruthSpot::Kind::kStar) ++count.detectable_stars;
    if (spot.kind == TruthSpot::Kind::kTarget) ++count.detectable_targets;
  }
  for (const auto& camera : dots) {
    for (const omma_Dot& dot : camera) {
      if (!used(dot)) continue;
      ++(dot.role == omma_DOT_STAR ? count.paired_stars : count.paired_targets);
    }
  }
  return count;
}

}  // namespace

Evaluation evaluate(const FlownMission& mission, const std::vector<TruthFrame>& truth, const FlightLog& log,
                    const std::string& log_path, BoundFrom bound) {
  const auto seconds = [&](const TruthFrame& frame) {
    return 1e-9 * static_cast<double>(frame.time_ns - truth.front().time_ns);
  };
  std::map<std::uint64_t, Judge> judges;
  Evaluation evaluation;
  evaluation.duration = seconds(truth.back());
  evaluation.attitude.frames = truth.size();
  evaluation.exposures_told = !truth.front().exposures.empty();
  evaluation.poses = bodies_to_judge(mission, truth);
  const SpotChoice counts = detectable(mission.least_snr);
  static const Dots kNoDots;
  for (const TruthFrame& frame : truth) {
    const auto dots = log.dots.find(frame.frame);
    const Dots& seen = dots == log.dots.end() ? kNoDots : dots->second;
    const SpotsByName names(frame, mission.bodies);
    judges.emplace(frame.frame,
                   Judge{mission, frame, seconds(frame), counts, used_spots(seen, names), bound});
    check_pairs(seen, names, evaluation.pairs);
    evaluation.counts.push_back(count_spots(frame, seconds(frame), counts, seen));
  }
  const auto judge_of = [&](std::uint64_t frame) -> const Judge& {
    const auto at = judges.find(frame);
    if (at == judges.end())
      throw InputError(log_path, 0, "frame", "frame sets that the truth knows", std::to_string(frame));
    return at->second;
  };
  for (const omma_Attitude& sample : log.attitudes) {
    const Judge& judge = judge_of(sample.frame);
    if (!sample.valid) continue;
    AttitudeEvaluation& attitude = evaluation.attitude;
    attitude.points.push_back(attitude_error(judge, sample));
    if (sample.filtered || sample.integrity.state == omma_INTEGRITY_NONE) continue;
    check_protection(attitude.points.back().error, sample.integrity.protection_rad, attitude.protection);
    attitude.protection.alerts += sample.integrity.state == omma_INTEGRITY_ALERT ? 1 : 0;
  }
  for (const omma_RelativePose& sample : log.poses) {
    const Judge& judge = judge_of(sample.frame);
    if (sample.body >= mission.bodies.size())
      throw InputError(log_path, 0, "relative_pose", std::to_string(mission.bodies.size()) + " bodies",
                       "body " + std::to_string(sample.body));
    PoseEvaluation& pose = evaluation.poses[sample.body];
    for (std::size_t b = 0; b < judge.truth.bodies.size(); ++b) {
      if (!sample.valid || sample.state == omma_SOLVE_UNOBSERVABLE || judge.truth.bodies[b].name != pose.body)
        continue;
      pose.points.push_back(pose_error(judge, mission.bodies[sample.body], b, sample));
      const Vector6d& error = pose.points.back().error;
      check_protection(error.head<3>(), sample.integrity.protection_rad, pose.protection);
      check_protection(error.tail<3>(), sample.integrity.protection_m, pose.protection);
      pose.protection.alerts += sample.integrity.state == omma_INTEGRITY_ALERT ? 1 : 0;
      if (!sample.motion_valid || sample.first_frame == sample.frame) continue;
      const auto first_frame = judges.find(sample.first_frame);
      if (first_frame == judges.end()) continue;  // a truth may begin after the first pose
      if (const Pose* first = pose_of(first_frame->second.truth, pose.body)) {
        pose.motion.first_frame = sample.first_frame;
        pose.motion.points.push_back(
            motion_error(judge, *first, judge.truth.bodies[b].rig_from_body, sample));
      }
    }
  }
  sum_up(evaluation.attitude);
  for (PoseEvaluation& pose : evaluation.poses) {
    sum_up(pose);
    sum_up(pose.motion);
  }
  return evaluation;
}

}  // namespace omma::ground
