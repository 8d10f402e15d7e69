#include "components/tracker/lookout.hpp"

#include <algorithm>
#include <cmath>

#include "components/tracker/camera_prediction.hpp"

namespace omma {
namespace {

constexpr double kSigmas = 5;          // of the prediction, to each side
constexpr double kMargin = 6;          // for the background around a dot [px]
constexpr double kWidths = 3.5;        // of a dot, from its centre to where its light ends
constexpr double kObjectReach = 8;     // of an unknown object, whose dot may be a trail [px]
constexpr int kSearchesAfterLoss = 3;  // whole searches that find a body again and its rate

}  // namespace

Lookout::Lookout(const LookoutParameters& parameters, const TrackerParameters& tracker, const Rig& rig,
                 std::size_t bodies)
    : parameters_(parameters),
      rig_(rig),
      sky_(tracker.sky_angular_acceleration),
      bodies_(bodies, PosePrediction(tracker.body_angular_acceleration, tracker.body_linear_acceleration)) {
  windows->cameras.resize(rig.cameras.size());
}

void Lookout::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.input("dots", dots);
  visitor.input("pairings", pairings);
  visitor.input("attitude", attitude);
  visitor.input("poses", poses);
  visitor.input("objects", objects);
  visitor.output("windows", windows);
}

void Lookout::step(const Tick& /*tick*/) noexcept {
  if (parameters_.full_search_every <= 1) return;  // as it was made: everywhere
  learn();
  if (was_full_) remember();
  if (!is_tracked()) lost_for_ = kSearchesAfterLoss;
  const bool full = must_search();
  since_full_ = full ? 1 : since_full_ + 1;
  was_full_ = full;
  lost_for_ = std::max(0, lost_for_ - 1);
  for (CameraWindows& camera : windows->cameras) {
    camera.everywhere = full;
    camera.windows.clear();
  }
  if (full) return;
  const TimeNs now = time_now();
  look_for_expected(now);
  look_for_objects(now);
}

void Lookout::learn() noexcept {
  if (attitude->valid)
    sky_.update(attitude->time_ns, attitude->solution.rig_from_j2000, attitude->solution.covariance);
  if (pairings->sky.state == TrackState::kLost) sky_.reset();
  for (const PoseEstimate& pose : poses->bodies)
    if (pose.valid && pose.body < bodies_.size())
      bodies_[pose.body].update(pose.time_ns, pose.solution.rig_from_body, pose.solution.covariance);
  for (const BodyPairings& body : pairings->bodies)
    if (body.state == TrackState::kLost && body.body < bodies_.size()) bodies_[body.body].reset();
}

// The pairs of a whole search, until the next.
void Lookout::remember() noexcept {
  expected_.clear();
  expect(pairings->sky.pairs, kSky);
  expect(pairings->sky.solar, kSky);
  for (const BodyPairings& body : pairings->bodies) expect(body.pairs, body.body);
}

void Lookout::expect(std::span<const Pairing> pairs, std::uint8_t body) noexcept {
  for (const Pairing& pair : pairs) {
    const auto& seen = dots->cameras[pair.camera].dots;
    if (pair.dot >= seen.size()) continue;  // of a frame set that was skipped
    const Dot& dot = seen[pair.dot];
    expected_.push_back({.point = pair.sight.point,
                         .reach = static_cast<float>(kWidths) * dot.sigma_major,
                         .camera = pair.camera,
                         .body = body});
  }
}

// The sky, and every body that was there when the whole images were last searched.
bool Lookout::is_tracked() const noexcept {
  if (pairings->sky.state != TrackState::kTracking || !sky_.ready()) return false;
  for (const BodyPairings& body : pairings->bodies) {
    if (body.state == TrackState::kAcquired) return false;
    const bool was_there = std::any_of(expected_.begin(), expected_.end(),
                                       [&](const Expected& e) { return e.body == body.body; });
    if (was_there && body.state == TrackState::kLost) return false;
  }
  return true;
}

bool Lookout::must_search() const noexcept {
  return lost_for_ > 0 || since_full_ == 0 || since_full_ >= parameters_.full_search_every;
}

TimeNs Lookout::time_now() const noexcept {
  for (const Frame& frame : frames->cameras)
    if (frame.status == FrameStatus::kFresh) return frame.exposure_midpoint_ns;
  return frames->trigger_time_ns;
}

void Lookout::add(std::size_t camera, const PredictedPoint& point, double reach) noexcept {
  const auto half = [&](int axis) {
    return kSigmas * std::sqrt(point.covariance(axis, axis)) + reach + kMargin;
  };
  SearchWindow window;
  window.left = static_cast<int>(std::floor(point.pixel.x() - half(0)));
  window.right = static_cast<int>(std::ceil(point.pixel.x() + half(0)));
  window.top = static_cast<int>(std::floor(point.pixel.y() - half(1)));
  window.bottom = static_cast<int>(std::ceil(point.pixel.y() + half(1)));
  CameraWindows& out = windows->cameras[camera];
  if (!out.windows.push_back(window)) out.everywhere = true;
}

void Lookout::look_for_expected(TimeNs now) noexcept {
  const PredictedAttitude sky = sky_.at(now);
  std::array<PredictedPose, limits::kTargetBodies> poses_now;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (bodies_[b].ready()) poses_now[b] = bodies_[b].at(now);
  for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
    const RigCamera& camera = rig_.cameras[c];
    const CameraPrediction in_camera(camera, c, sky, {});
    for (const Expected& expected : expected_) {
      if (expected.camera != c) continue;
      PredictedPoint point;
      const bool seen = expected.body == kSky
                            ? in_camera.point(expected.point, 0, point)
                            : bodies_[expected.body].ready() &&
                                  predict_target(camera, poses_now[expected.body], expected.point, point);
      if (seen) add(c, point, static_cast<double>(expected.reach));
    }
  }
}

// In all cameras: one may go from one to the next.
void Lookout::look_for_objects(TimeNs now) noexcept {
  const PredictedAttitude sky = sky_.at(now);
  const double seconds = 1e-9 * static_cast<double>(now - objects->time_ns);
  for (const UnknownObject& object : objects->objects) {
    const Eigen::Vector3d direction = (object.direction + seconds * object.velocity).normalized();
    const double sigma =
        std::sqrt(object.covariance.trace() + seconds * seconds * object.velocity_covariance.trace());
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      const CameraPrediction in_camera(rig_.cameras[c], c, sky, {});
      PredictedPoint point;
      if (in_camera.point(direction, sigma, point)) add(c, point, kObjectReach);
    }
  }
}

}  // namespace omma
