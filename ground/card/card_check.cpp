#include "ground/card/card_check.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/geometry/rig_dot.hpp"
#include "components/tracker/target_identification.hpp"
#include "sim/random.hpp"

namespace omma::ground {
namespace {

using Triple = std::array<std::size_t, 3>;

// A wide triple: the two targets farthest apart, and the one farthest from their line.
Triple widest_triple(const TargetBody& body) {
  Triple t{0, 0, 0};
  double longest = -1;
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    for (std::size_t k = i + 1; k < body.targets.size(); ++k) {
      const double apart = (body.targets[i].position - body.targets[k].position).norm();
      if (apart > longest) {
        longest = apart;
        t[0] = i;
        t[1] = k;
      }
    }
  }
  const Eigen::Vector3d along = (body.targets[t[1]].position - body.targets[t[0]].position).normalized();
  double widest = -1;
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    const double off = along.cross(body.targets[i].position - body.targets[t[0]].position).norm();
    if (off > widest) {
      widest = off;
      t[2] = i;
    }
  }
  return t;
}

// Rigid motion that carries the first triple onto the second (Kabsch 1976).
Pose motion_between(const TargetBody& body, const Triple& from, const Triple& to) {
  Eigen::Matrix3d a;
  Eigen::Matrix3d b;
  for (int k = 0; k < 3; ++k) {
    a.col(k) = body.targets[from[static_cast<std::size_t>(k)]].position;
    b.col(k) = body.targets[to[static_cast<std::size_t>(k)]].position;
  }
  const Eigen::Vector3d ca = a.rowwise().mean();
  const Eigen::Vector3d cb = b.rowwise().mean();
  const Eigen::Matrix3d h = (a.colwise() - ca) * (b.colwise() - cb).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation = svd.matrixV() * sign * svd.matrixU().transpose();
  return {Eigen::Quaterniond(rotation).normalized(), cb - rotation * ca};
}

std::size_t targets_matched(const TargetBody& body, const Pose& motion, double tolerance) {
  std::size_t matched = 0;
  for (const Target& target : body.targets) {
    const Eigen::Vector3d moved = motion * target.position;
    matched += std::any_of(body.targets.begin(), body.targets.end(),
                           [&](const Target& other) { return (moved - other.position).norm() <= tolerance; });
  }
  return matched;
}

// Seeded by range and trial alone.
class Draw {
 public:
  Draw(std::uint64_t stream, std::uint64_t trial) : sequence_(77, stream, trial) {}
  double uniform() { return sim::uniform(sequence_[next_++]); }
  double normal() { return sim::inverse_normal(uniform()); }

 private:
  sim::RandomSequence sequence_;
  std::uint64_t next_ = 0;
};

// Somewhere in the image, tilted to any side, turned any way.
Pose drawn_pose(const Lens& lens, double range, double largest_tilt, Draw& draw) {
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();
  for (int attempt = 0; attempt < 50; ++attempt) {
    const Eigen::Vector2d pixel(draw.uniform() * (lens.width() - 1), draw.uniform() * (lens.height() - 1));
    if (lens.bearing(pixel, ray)) break;
  }
  const Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -ray);
  const double tilt = largest_tilt * std::sqrt(draw.uniform());
  const double side = 2 * std::numbers::pi * draw.uniform();
  const double turn = 2 * std::numbers::pi * draw.uniform();
  const Eigen::Quaterniond rotation =
      facing * rotation_exp({tilt * std::cos(side), tilt * std::sin(side), 0}) * rotation_exp({0, 0, turn});
  return {rotation.normalized(), range * ray};
}

struct Seen {
  std::vector<RigDot> dots;
  std::vector<std::uint16_t> target;  ///< of each dot
};

Seen see(const TargetBody& body, const RigCamera& camera, const Pose& pose, const CheckOptions& options,
         Draw& draw) {
  Seen seen;
  for (std::size_t t = 0; t < body.targets.size(); ++t) {
    const double fate = draw.uniform();
    const Eigen::Vector2d noise = options.dot_sigma * Eigen::Vector2d(draw.normal(), draw.normal());
    Dot dot;
    if (fate < options.hidden || !camera.lens.project(pose * body.targets[t].position, dot.pixel)) continue;
    dot.pixel += noise;
    dot.covariance = options.dot_sigma * options.dot_sigma * Eigen::Matrix2d::Identity();
    dot.snr = 50;
    dot.flux = 1000;
    RigDot rig_seen;
    if (!rig_dot(dot, static_cast<std::uint16_t>(seen.dots.size()), camera, 0, 0, rig_seen)) continue;
    seen.dots.push_back(rig_seen);
    seen.target.push_back(static_cast<std::uint16_t>(t));
  }
  return seen;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Likeness nearest_likeness(const TargetBody& body, double tolerance) {
  Likeness best;
  if (body.targets.size() < 3) return best;
  const Triple from = widest_triple(body);
  const auto at = [&](std::size_t i) -> const Eigen::Vector3d& { return body.targets[i].position; };
  const double ab = (at(from[0]) - at(from[1])).norm();
  const double ac = (at(from[0]) - at(from[2])).norm();
  const double bc = (at(from[1]) - at(from[2])).norm();
  const std::size_t count = body.targets.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < count; ++k) {
      if (k == i || std::abs((at(i) - at(k)).norm() - ab) > 2 * tolerance) continue;
      for (std::size_t m = 0; m < count; ++m) {
        if (m == i || m == k || std::abs((at(i) - at(m)).norm() - ac) > 2 * tolerance ||
            std::abs((at(k) - at(m)).norm() - bc) > 2 * tolerance) {
          continue;
        }
        const Pose motion = motion_between(body, from, {i, k, m});
        const double angle = rotation_log(motion.rotation).norm();
        const bool over_its_face = (motion.rotation * Eigen::Vector3d::UnitZ()).z() < 0;
        if (over_its_face || (angle < 0.02 && motion.translation.norm() < tolerance)) continue;
        const std::size_t matched = targets_matched(body, motion, tolerance);
        if (matched > best.matched) best = {angle, matched};
      }
    }
  }
  return best;
}

RangeCheck check_at(const TargetBody& body, const Lens& lens, double range, const CheckOptions& options) {
  RangeCheck check;
  check.range = range;
  RigCamera camera;
  camera.lens = lens;
  TargetIdentifier identifier(body);
  std::vector<double> position;
  std::vector<double> rotation;
  const auto stream = static_cast<std::uint64_t>(std::llround(1e6 * range));
  for (int trial = 0; trial < options.trials; ++trial) {
    Draw draw(stream, static_cast<std::uint64_t>(trial));
    const Pose truth = drawn_pose(lens, range, options.largest_tilt, draw);
    const Seen seen = see(body, camera, truth, options, draw);
    if (seen.dots.size() < 4) continue;
    ++check.trials;
    const TargetIdentification found = identifier.identify(seen.dots);
    if (found.status == TargetIdentificationStatus::kAmbiguous) ++check.ambiguous;
    if (found.status != TargetIdentificationStatus::kIdentified) continue;
    std::size_t wrong = 0;
    for (const TargetPair& pair : found.pairs) wrong += seen.target[pair.dot] != pair.target ? 1 : 0;
    if (10 * wrong > found.pairs.size()) {
      ++check.wrong;
      continue;
    }
    ++check.right;
    if (found.pose.ambiguous) ++check.mirrored;
    position.push_back(std::sqrt(found.pose.covariance.bottomRightCorner<3, 3>().trace()));
    rotation.push_back(std::sqrt(found.pose.covariance.topLeftCorner<3, 3>().trace()));
  }
  check.position_sigma = median(std::move(position));
  check.rotation_sigma = median(std::move(rotation));
  return check;
}

}  // namespace omma::ground
