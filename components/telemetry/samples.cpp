// Field by field from the components' messages to the structs of the IDL.
#include "components/telemetry/samples.hpp"

#include "components/telemetry/idl_enumerations.hpp"

namespace omma::telemetry {
namespace {

omma_Quaternion quaternion(const Eigen::Quaterniond& q) noexcept {
  return {q.x(), q.y(), q.z(), q.w()};
}

omma_Vector3 vector(const Eigen::Vector3d& v) noexcept {
  return {v.x(), v.y(), v.z()};
}

// Row after row, whatever Eigen's own order.
template <class Matrix>
void put_matrix(const Matrix& matrix, double* out) noexcept {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) *out++ = matrix(row, column);
}

void put_in_j2000(const Eigen::Quaterniond& rig_from_j2000, const Eigen::Matrix3d& covariance,
                  double* out) noexcept {
  const Eigen::Matrix3d rotation = rig_from_j2000.toRotationMatrix();
  const Eigen::Matrix3d in_j2000 = rotation.transpose() * covariance * rotation;
  put_matrix(in_j2000, out);
}

std::uint32_t star_count(const Pairings& pairings, std::size_t camera) noexcept {
  return static_cast<std::uint32_t>(
      std::count_if(pairings.sky.pairs.begin(), pairings.sky.pairs.end(),
                    [camera](const Pairing& pair) { return pair.camera == camera; }));
}

std::uint32_t target_count(const Pairings& pairings, std::size_t camera) noexcept {
  std::uint32_t count = 0;
  for (const BodyPairings& body : pairings.bodies)
    for (const Pairing& pair : body.pairs) count += pair.camera == camera ? 1U : 0U;
  return count;
}

omma_Dot unpaired(const Dot& dot) noexcept {
  omma_Dot out{};
  out.u_px = static_cast<float>(dot.pixel.x());
  out.v_px = static_cast<float>(dot.pixel.y());
  out.covariance_uu_px2 = static_cast<float>(dot.covariance(0, 0));
  out.covariance_uv_px2 = static_cast<float>(dot.covariance(0, 1));
  out.covariance_vv_px2 = static_cast<float>(dot.covariance(1, 1));
  out.flux_levels = dot.flux;
  out.snr = dot.snr;
  out.flags = dot.flags;
  return out;
}

omma_Dot* dot_of(const Pairing& pair, std::span<omma_CameraDots> cameras) noexcept {
  if (pair.camera >= cameras.size()) return nullptr;
  omma_CameraDots& dots = cameras[pair.camera];
  return pair.dot < dots.dots._length ? &dots.dots._buffer[pair.dot] : nullptr;
}

/// What every claim of a dot says. @return null where the pair points at no dot
omma_Dot* claimed_dot(const Pairing& pair, std::span<omma_CameraDots> cameras, omma_DotRole role) noexcept {
  omma_Dot* dot = dot_of(pair, cameras);
  if (dot == nullptr) return nullptr;
  dot->role = role;
  dot->entry = pair.entry;
  dot->persistence = pair.persistence;
  dot->age_s = 1e-9F * static_cast<float>(cameras[pair.camera].time_ns - pair.since_ns);
  return dot;
}

// The whitener has no component along the ray, so the whitened direction is the whitened difference.
float residual_sigma(const Sight& sight, const Eigen::Vector3d& predicted) noexcept {
  return static_cast<float>((sight.whitener * predicted).norm());
}

}  // namespace

void fill(const Frames& frames, const DotLists& dots, const Pairings& pairings, omma_FrameSet& out) noexcept {
  out.frame = dots.frame;
  out.time_ns = dots.time_ns;
  out.valid = true;
  out.sky_state = same<omma_TrackState>(pairings.sky.state);
  out.stars_paired = static_cast<std::uint32_t>(pairings.sky.pairs.size());
  out.targets_paired = 0;
  for (const BodyPairings& body : pairings.bodies)
    out.targets_paired += static_cast<std::uint32_t>(body.pairs.size());
  out.unclaimed_dots = pairings.unclaimed_dots;
  const std::size_t count = std::min<std::size_t>(out.cameras._maximum, dots.cameras.size());
  out.cameras._length = static_cast<std::uint32_t>(count);
  for (std::size_t c = 0; c < count; ++c) {
    omma_CameraStatus& status = out.cameras._buffer[c];
    const DotList& list = dots.cameras[c];
    const bool has_frame = c < frames.cameras.size();
    status.state = same<omma_FrameState>(has_frame ? frames.cameras[c].status : FrameStatus::kMissing);
    status.image_number = has_frame ? frames.cameras[c].number : 0;
    status.exposure_midpoint_ns = has_frame ? frames.cameras[c].exposure_midpoint_ns : 0;
    status.images_rejected = has_frame ? frames.rejected[c] : 0;
    status.dots_kept = static_cast<std::uint32_t>(list.dots.size());
    status.dots_found = status.dots_kept + list.dropped;
    status.stars_paired = star_count(pairings, c);
    status.targets_paired = target_count(pairings, c);
    status.background_levels = list.background;
    status.noise_levels = list.noise;
    const CameraSettings taken_with = has_frame ? frames.cameras[c].settings : CameraSettings{};
    status.exposure_ms = 1e-6F * static_cast<float>(taken_with.exposure_ns);
    status.gain = taken_with.gain;
    status.black_level_levels = taken_with.black_level;
    status.exposure_state = omma_EXPOSURE_FIXED;
    status.full_share = 0;
    status.exposures_refused = 0;
  }
}

void fill(const ExposureReport& report, omma_FrameSet& out) noexcept {
  const std::size_t count = std::min<std::size_t>(out.cameras._length, report.cameras.size());
  for (std::size_t c = 0; c < count; ++c) {
    const CameraExposure& camera = report.cameras[c];
    omma_CameraStatus& status = out.cameras._buffer[c];
    status.exposures_refused = camera.refused;
    if (!camera.automatic && camera.state != ExposureState::kBracket) continue;
    status.exposure_state = after_first<omma_ExposureState>(camera.state);
    status.full_share = static_cast<float>(camera.seen.full);
  }
}

void fill(const DotLists& lists, std::size_t camera, omma_CameraDots& out) noexcept {
  const DotList& list = lists.cameras[camera];
  out.frame = lists.frame;
  out.time_ns = list.time_ns;
  out.valid = list.status == FrameStatus::kFresh;
  out.camera = static_cast<std::uint8_t>(camera);
  out.dots._length = static_cast<std::uint32_t>(list.dots.size());
  std::transform(list.dots.begin(), list.dots.end(), out.dots._buffer, unpaired);
}

void claim(const SkyPairings& sky, const AttitudeEstimate& attitude,
           std::span<omma_CameraDots> cameras) noexcept {
  const Eigen::Matrix3d rig_from_j2000 = attitude.solution.rig_from_j2000.toRotationMatrix();
  for (std::size_t i = 0; i < sky.pairs.size(); ++i) {
    const Pairing& pair = sky.pairs[i];
    omma_Dot* dot = claimed_dot(pair, cameras, omma_DOT_STAR);
    if (dot == nullptr) continue;
    if (!attitude.valid) continue;
    dot->culled = i < attitude.used.size() && attitude.used[i] == 0;
    dot->residual_sigma = residual_sigma(pair.sight, rig_from_j2000 * pair.sight.point);
  }
  for (const Pairing& pair : sky.solar) {
    omma_Dot* dot = claimed_dot(pair, cameras, omma_DOT_SOLAR_BODY);
    if (dot != nullptr && attitude.valid)
      dot->residual_sigma = residual_sigma(pair.sight, rig_from_j2000 * pair.sight.point);
  }
}

void claim(const UnknownObjects& objects, std::span<omma_CameraDots> cameras) noexcept {
  for (const UnknownObject& object : objects.objects) {
    if (!object.bearing.seen) continue;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      if (object.bearing.dot[c] < 0) continue;
      Pairing pair;
      pair.camera = static_cast<std::uint8_t>(c);
      pair.dot = static_cast<std::uint16_t>(object.bearing.dot[c]);
      pair.entry = static_cast<std::uint16_t>(object.number);
      pair.persistence = object.sightings;
      pair.since_ns = object.first_seen_ns;
      claimed_dot(pair, cameras, omma_DOT_OBJECT);
    }
  }
}

void claim(const BodyPairings& body, const PoseEstimate* pose, std::span<omma_CameraDots> cameras) noexcept {
  for (std::size_t i = 0; i < body.pairs.size(); ++i) {
    const Pairing& pair = body.pairs[i];
    omma_Dot* dot = claimed_dot(pair, cameras, omma_DOT_TARGET);
    if (dot == nullptr) continue;
    dot->body = body.body;
    if (pose == nullptr || !pose->valid) continue;
    dot->culled = i < pose->used.size() && pose->used[i] == 0;
    const Eigen::Vector3d from_camera = pose->solution.rig_from_body * pair.sight.point - pair.sight.origin;
    dot->residual_sigma = residual_sigma(pair.sight, from_camera.normalized());
  }
}

namespace {

void fill(const Integrity& integrity, omma_Integrity& out) noexcept {
  out.state = same<omma_IntegrityState>(integrity.state);
  out.risk = integrity.risk;
  out.freedom = integrity.freedom;
  out.chi2_probability = integrity.chi2_probability;
  out.suspect_dot_camera = integrity.suspect_dot.camera;
  out.suspect_dot_entry = integrity.suspect_dot.entry;
  out.suspect_dot_sigma = integrity.suspect_dot_sigma;
  out.suspect_camera = integrity.suspect_camera;
  out.suspect_camera_probability = integrity.suspect_camera_probability;
  out.cameras_checked = integrity.cameras_checked;
  out.dot_separation_rad = integrity.dot_separation_rad;
  out.dot_separation_m = integrity.dot_separation_m;
  out.camera_separation_rad = integrity.camera_separation_rad;
  out.camera_separation_m = integrity.camera_separation_m;
  out.weakest_rotation = vector(integrity.weakest_rotation.direction);
  out.weakest_rotation_sigma_rad = integrity.weakest_rotation.sigma;
  out.weakest_position = vector(integrity.weakest_position.direction);
  out.weakest_position_sigma_m = integrity.weakest_position.sigma;
  out.protection_rad = vector(integrity.rig.protection_level.head<3>());
  out.protection_m = vector(integrity.rig.protection_level.tail<3>());
  out.body_protection_rad = vector(integrity.body.protection_level.head<3>());
  out.body_protection_m = vector(integrity.body.protection_level.tail<3>());
}

}  // namespace

void fill(const AttitudeEstimate& attitude, omma_Attitude& out) noexcept {
  const AttitudeSolution& solution = attitude.solution;
  out.frame = attitude.frame;
  out.time_ns = attitude.time_ns;
  out.valid = attitude.valid;
  out.state = same<omma_SolveState>(solution.status);
  out.rig_from_j2000 = quaternion(solution.rig_from_j2000);
  const Eigen::Matrix3d covariance = attitude.integrity.rig.covariance.topLeftCorner<3, 3>();
  put_matrix(covariance, out.covariance_rad2);
  out.rate_valid = attitude.rate_valid;
  out.rate_rad_s = vector(attitude.rate);
  put_matrix(attitude.rate_covariance, out.rate_covariance_rad2_s2);
  out.chi2 = solution.chi2;
  out.residual_rms_rad = solution.residual_rms;
  out.stars_used = solution.pairs;
  out.stars_culled = solution.culled;
  out.iterations = solution.iterations;
  fill(attitude.integrity, out.integrity);
  put_in_j2000(solution.rig_from_j2000, covariance, out.covariance_j2000_rad2);
  const FilteredAttitude& filtered = attitude.filtered;
  out.filtered = filtered.valid;
  if (!filtered.valid) return;
  out.valid = true;
  out.rig_from_j2000 = quaternion(filtered.rig_from_j2000);
  put_matrix(filtered.covariance, out.covariance_rad2);
  put_in_j2000(filtered.rig_from_j2000, filtered.covariance, out.covariance_j2000_rad2);
  out.rate_valid = true;
  out.rate_rad_s = vector(filtered.rate);
  put_matrix(filtered.rate_covariance, out.rate_covariance_rad2_s2);
}

void fill(const PoseEstimate& pose, std::string_view body_name, omma_RelativePose& out) noexcept {
  const PoseSolution& solution = pose.solution;
  out.frame = pose.frame;
  out.time_ns = pose.time_ns;
  out.valid = pose.position_valid;
  out.rotation_valid = pose.rotation_valid;
  out.body = pose.body;
  set_text(out.body_name, body_name);
  out.state = same<omma_SolveState>(solution.status);
  out.rig_from_body = quaternion(solution.rig_from_body.rotation);
  out.position_m = vector(solution.rig_from_body.translation);
  put_matrix(pose.integrity.rig.covariance, out.covariance);
  out.rig_position_m = vector(solution.rig_from_body.inverse().translation);
  put_matrix(pose.integrity.body.covariance, out.body_covariance);
  fill(pose.integrity, out.integrity);
  out.chi2 = solution.chi2;
  out.residual_rms_rad = solution.residual_rms;
  out.targets_used = solution.pairs;
  out.targets_culled = solution.culled;
  out.iterations = solution.iterations;
  out.ambiguous = solution.ambiguous;
  out.has_alternative = solution.has_alternative;
  out.alternative_rig_from_body = quaternion(solution.alternative.rotation);
  out.alternative_position_m = vector(solution.alternative.translation);
  out.alternative_chi2 = solution.alternative_chi2;
  out.alternative_probability = solution.alternative_probability;
  const BodyMotion& motion = pose.motion;
  out.motion_valid = motion.valid;
  out.first_frame = motion.first_frame;
  out.motion = quaternion(motion.since_first.rotation);
  out.motion_m = vector(motion.since_first.translation);
  put_matrix(motion.covariance, out.motion_covariance);
}

void fill(const ApproachEstimate& approach, std::string_view body_name, omma_Approach& out) noexcept {
  out.frame = approach.frame;
  out.time_ns = approach.time_ns;
  out.valid = approach.mode != RangeMode::kNone;
  out.body = approach.body;
  set_text(out.body_name, body_name);
  out.mode = same<omma_RangeMode>(approach.mode);
  out.seen = approach.seen;
  out.object = approach.object;
  out.snr = approach.snr;
  out.direction = vector(approach.direction);
  put_matrix(approach.covariance, out.covariance_direction_rad2);
  out.inertial_valid = approach.inertial_valid;
  out.direction_j2000 = vector(approach.direction_j2000);
  put_matrix(approach.covariance_j2000, out.covariance_direction_j2000_rad2);
  out.range_valid = approach.range_valid;
  out.range_m = approach.range;
  out.range_sigma_m = approach.range_sigma;
  out.range_rate_m_s = approach.range_rate;
  out.range_rate_sigma_m_s = approach.range_rate_sigma;
  out.magnitude_at_1m = approach.magnitude_at_1m;
  out.magnitude_sigma = approach.magnitude_sigma;
}

void fill(const UnknownObjects& objects, omma_UnknownObjects& out) noexcept {
  out.frame = objects.frame;
  out.time_ns = objects.time_ns;
  out.valid = objects.valid;
  out.leftover_dots = objects.leftover_dots;
  out.candidates = objects.candidates;
  out.not_followed = objects.not_followed;
  out.objects._length = static_cast<std::uint32_t>(objects.objects.size());
  for (std::size_t i = 0; i < objects.objects.size(); ++i) {
    const UnknownObject& object = objects.objects[i];
    omma_UnknownObject& to = out.objects._buffer[i];
    to.number = object.number;
    to.motion = same<omma_ObjectMotion>(object.motion);
    to.seen = object.bearing.seen;
    to.first_seen_ns = object.first_seen_ns;
    to.last_seen_ns = object.last_seen_ns;
    to.sightings = object.sightings;
    to.missed = object.missed;
    to.cameras = 0;
    for (std::size_t c = 0; c < object.bearing.dot.size(); ++c)
      if (object.bearing.seen && object.bearing.dot[c] >= 0) to.cameras |= static_cast<std::uint8_t>(1U << c);
    to.flux_levels = object.bearing.flux;
    to.snr = object.bearing.snr;
    to.bearing = vector(object.bearing.direction);
    put_matrix(object.bearing.covariance, to.covariance_bearing_rad2);
    to.direction = vector(object.direction);
    put_matrix(object.covariance, to.covariance_direction_rad2);
    to.velocity_rad_s = vector(object.velocity);
    put_matrix(object.velocity_covariance, to.covariance_velocity_rad2_s2);
    to.score = static_cast<float>(object.score);
  }
}

void fill(const ImageChunk& chunk, omma_ImageChunk& out) noexcept {
  out.frame = chunk.frame;
  out.time_ns = chunk.time_ns;
  out.valid = chunk.valid;
  out.kind = same<omma_ImageKind>(chunk.kind);
  out.composite = same<omma_ImageComposite>(chunk.composite);
  out.composed = chunk.composed;
  out.camera = chunk.camera;
  out.image = chunk.image;
  out.width_px = chunk.width;
  out.height_px = chunk.height;
  out.left_px = chunk.left;
  out.top_px = chunk.top;
  out.first_row = chunk.first_row;
  out.rows = chunk.rows;
  out.encoding = same<omma_ImageEncoding>(chunk.encoding);
  out.bits = chunk.bits;
  out.scale = same<omma_ImageScale>(chunk.scale);
  out.light_most = chunk.light_most;
  out.light_soft = chunk.light_soft;
  out.pan_rad = chunk.pan;
  out.tilt_rad = chunk.tilt;
  out.field_rad = chunk.field;
  const std::size_t bytes = std::min<std::size_t>(chunk.pixels.size(), chunk.bytes);
  out.pixels._length = static_cast<std::uint32_t>(bytes);
  std::copy_n(chunk.pixels.begin(), bytes, out.pixels._buffer);
}

void fill(const MotionReport& motion, omma_Motion& out) noexcept {
  out.time_ns = motion.time_ns;
  out.valid = motion.valid;
  out.mode = same<omma_MotionMode>(motion.mode);
  out.trajectory_time_s = motion.trajectory_time;
  out.late_ticks = motion.late_ticks;
  out.refused_commands = motion.refused_commands;
  out.board_lost = motion.board_lost;
  const std::size_t count = std::min<std::size_t>(out.axes._maximum, motion.axes.size());
  out.axes._length = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const AxisCommand& axis = motion.axes[i];
    omma_AxisCommand& to = out.axes._buffer[i];
    to.angle_rad = axis.state.angle;
    to.speed_rad_s = axis.state.speed;
    to.goal_rad = axis.goal.angle;
    to.pulse_quarter_us = axis.pulse;
  }
}

}  // namespace omma::telemetry
