// Quaternions, right ascension, declination and roll side by side; uncertainties beside each value; ages.
#include "ground/monitor/monitor_table.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>

#include "components/geometry/angles.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

using telemetry::TopicId;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kArcseconds = 3600.0 * kDegrees;

const char* name_of(omma_FrameState state) {
  static constexpr const char* kNames[] = {"missing", "fresh", "late", "stuck", "saturated", "mismatched"};
  return kNames[static_cast<std::size_t>(state)];
}
const char* name_of(omma_ExposureState state) {
  static constexpr const char* kNames[] = {"fixed", "good", "waiting", "at its limit", "bracket"};
  return kNames[static_cast<std::size_t>(state)];
}
const char* name_of(omma_TrackState state) {
  static constexpr const char* kNames[] = {"lost", "acquired", "tracking"};
  return kNames[static_cast<std::size_t>(state)];
}
const char* name_of(omma_SolveState state) {
  static constexpr const char* kNames[] = {"none",          "solved",       "iteration cap",
                                           "too few pairs", "unobservable", "inconsistent"};
  return kNames[static_cast<std::size_t>(state)];
}
const char* name_of(omma_HealthState state) {
  static constexpr const char* kNames[] = {"ok", "degraded", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}
const char* name_of(omma_ObjectMotion motion) {
  static constexpr const char* kNames[] = {"undecided", "moving", "with the stars", "with the rig"};
  return kNames[static_cast<std::size_t>(motion)];
}
const char* name_of(omma_EventSeverity severity) {
  static constexpr const char* kNames[] = {"diagnostic", "activity", "warning", "failure"};
  return kNames[static_cast<std::size_t>(severity)];
}
const char* name_of(omma_MotionMode mode) {
  static constexpr const char* kNames[] = {"to the start", "running", "finished",
                                           "going home",   "at home", "EMERGENCY STOP"};
  return kNames[static_cast<std::size_t>(mode)];
}

const char* name_of(omma_IntegrityState state) {
  static constexpr const char* kNames[] = {"none", "sound", "unchecked", "ALERT"};
  return kNames[static_cast<std::size_t>(state)];
}

Eigen::Quaterniond eigen(const omma_Quaternion& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

class Table {
 public:
  Table(const NewestSamples& samples, SteadyClock::time_point now) : samples_(samples), now_(now) {}

  void add(TopicId topic, LineStyle style, std::string text) {
    const std::optional<double> age = samples_.age(topic, now_);
    lines_.push_back({std::move(text), age && *age > kStaleAfter ? LineStyle::kStale : style});
  }
  /// Of what stays true however old it is.
  void lasting(LineStyle style, std::string text) { lines_.push_back({std::move(text), style}); }
  void plain(std::string text) { lines_.push_back({std::move(text), LineStyle::kPlain}); }
  /// A heading with the age of what stands below it.
  /// @param lasting  what stands there does not grow stale
  void heading(const char* title, TopicId topic, bool lasting = false) {
    const std::optional<double> age = samples_.age(topic, now_);
    const std::string note = !age                             ? "nothing yet"
                             : *age > kStaleAfter && !lasting ? format("STALE, %.0f s old", *age)
                                                              : format("%.1f s ago", *age);
    if (!lines_.empty()) plain("");
    lines_.push_back({format("%-10s %s", title, note.c_str()), LineStyle::kHeading});
  }
  std::vector<TableLine> take() { return std::move(lines_); }

 private:
  const NewestSamples& samples_;
  SteadyClock::time_point now_;
  std::vector<TableLine> lines_;
};

void add_cameras(Table& table, const omma_FrameSet& frame_set) {
  table.add(TopicId::kFrameSet, LineStyle::kPlain,
            format("frame set %llu   on-board time %.3f s   sky %s   stars %u   targets %u   unclaimed %u",
                   static_cast<unsigned long long>(frame_set.frame),
                   static_cast<double>(frame_set.time_ns) * 1e-9, name_of(frame_set.sky_state),
                   frame_set.stars_paired, frame_set.targets_paired, frame_set.unclaimed_dots));
  table.plain("camera       state       dots  found  stars  targets  background    noise  rejected");
  for (std::uint32_t c = 0; c < frame_set.cameras._length; ++c) {
    const omma_CameraStatus& camera = frame_set.cameras._buffer[c];
    table.add(TopicId::kFrameSet, camera.state == omma_FRAME_FRESH ? LineStyle::kGood : LineStyle::kWarning,
              format("%-12s %-10s %5u %6u %6u %8u %11.1f %8.2f %9llu", camera.name, name_of(camera.state),
                     camera.dots_kept, camera.dots_found, camera.stars_paired, camera.targets_paired,
                     static_cast<double>(camera.background_levels), static_cast<double>(camera.noise_levels),
                     static_cast<unsigned long long>(camera.images_rejected)));
    if (camera.exposure_ms > 0)
      table.add(TopicId::kFrameSet, camera.exposures_refused > 0 ? LineStyle::kWarning : LineStyle::kPlain,
                format("  exposed %.3f ms, gain %.2f, black level %.1f   %s, %.2f %% full   refused %u",
                       static_cast<double>(camera.exposure_ms), static_cast<double>(camera.gain),
                       static_cast<double>(camera.black_level_levels), name_of(camera.exposure_state),
                       100.0 * static_cast<double>(camera.full_share), camera.exposures_refused));
  }
}

double length(const omma_Vector3& v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/// What contradicts the solution most.
std::string suspicion(const omma_Integrity& integrity) {
  return format(
      "integrity        %s   chi2 by chance %.2g   dot %u:%u at %.1f sigma   camera %u by chance %.2g%s",
      name_of(integrity.state), integrity.chi2_probability, integrity.suspect_dot_camera,
      integrity.suspect_dot_entry, integrity.suspect_dot_sigma, integrity.suspect_camera,
      integrity.suspect_camera_probability, integrity.cameras_checked ? "" : "   not all cameras checked");
}

LineStyle style_of(const omma_Integrity& integrity) {
  return integrity.state == omma_INTEGRITY_SOUND       ? LineStyle::kGood
         : integrity.state == omma_INTEGRITY_UNCHECKED ? LineStyle::kWarning
                                                       : LineStyle::kBad;
}

void add_attitude(Table& table, const omma_Attitude& attitude) {
  const LineStyle style = attitude.valid ? LineStyle::kGood : LineStyle::kBad;
  table.add(TopicId::kAttitude, style,
            format("%s   stars %u used, %u culled   chi2 %.1f   residual %.1f arcsec rms",
                   attitude.valid ? name_of(attitude.state) : "NOT VALID", attitude.stars_used,
                   attitude.stars_culled, attitude.chi2, attitude.residual_rms_rad * kArcseconds));
  if (!attitude.valid) return;
  const omma_Quaternion& q = attitude.rig_from_j2000;
  const Pointing axis = pointing(eigen(q));
  table.add(TopicId::kAttitude, style,
            format("rig_from_j2000   x %+.7f  y %+.7f  z %+.7f  w %+.7f", q.x, q.y, q.z, q.w));
  table.add(TopicId::kAttitude, style,
            format("rig z axis       RA %.4f  Dec %+.4f  roll %.4f deg", axis.right_ascension * kDegrees,
                   axis.declination * kDegrees, axis.roll * kDegrees));
  const double* covariance = attitude.covariance_rad2;
  table.add(TopicId::kAttitude, style,
            format("1-sigma          x %.2f  y %.2f  z %.2f arcsec", std::sqrt(covariance[0]) * kArcseconds,
                   std::sqrt(covariance[4]) * kArcseconds, std::sqrt(covariance[8]) * kArcseconds));
  const omma_Integrity& integrity = attitude.integrity;
  table.add(TopicId::kAttitude, style_of(integrity), suspicion(integrity));
  table.add(
      TopicId::kAttitude, style_of(integrity),
      format("protection       x %.1f  y %.1f  z %.1f arcsec at %.0e   weakest axis %.1f arcsec 1-sigma",
             integrity.protection_rad.x * kArcseconds, integrity.protection_rad.y * kArcseconds,
             integrity.protection_rad.z * kArcseconds, integrity.risk,
             integrity.weakest_rotation_sigma_rad * kArcseconds));
  if (!attitude.rate_valid) return;
  const omma_Vector3& rate = attitude.rate_rad_s;
  table.add(TopicId::kAttitude, style,
            format("rate             x %+.4f  y %+.4f  z %+.4f deg/s", rate.x * kDegrees, rate.y * kDegrees,
                   rate.z * kDegrees));
}

std::string doubt(const omma_RelativePose& pose) {
  if (!pose.valid || !pose.ambiguous) return "";
  if (!pose.has_alternative) return "   AMBIGUOUS";
  return format("   AMBIGUOUS (the other pose %.1f %%)", 100 * pose.alternative_probability);
}

void add_pose(Table& table, const omma_RelativePose& pose) {
  const LineStyle style = !pose.valid      ? LineStyle::kBad
                          : pose.ambiguous ? LineStyle::kWarning
                                           : LineStyle::kGood;
  table.add(TopicId::kRelativePose, style,
            format("%-12s %s   targets %u used, %u culled   residual %.1f arcsec rms%s", pose.body_name,
                   pose.valid ? name_of(pose.state) : "NOT VALID", pose.targets_used, pose.targets_culled,
                   pose.residual_rms_rad * kArcseconds, doubt(pose).c_str()));
  if (!pose.valid) return;
  const omma_Vector3& p = pose.position_m;
  const double* covariance = pose.covariance;
  auto sigma = [covariance](int i) { return std::sqrt(covariance[7 * i]); };
  table.add(TopicId::kRelativePose, style,
            format("  position       x %+.4f  y %+.4f  z %+.4f m   range %.4f m", p.x, p.y, p.z, length(p)));
  table.add(TopicId::kRelativePose, style,
            format("  1-sigma        x %.4f  y %.4f  z %.4f m", sigma(3), sigma(4), sigma(5)));
  const omma_Integrity& integrity = pose.integrity;
  table.add(TopicId::kRelativePose, style_of(integrity), "  " + suspicion(integrity));
  table.add(TopicId::kRelativePose, style_of(integrity),
            format("  protection     x %.4f  y %.4f  z %.4f m   rotation %.3f deg   at %.0e",
                   integrity.protection_m.x, integrity.protection_m.y, integrity.protection_m.z,
                   length(integrity.protection_rad) * kDegrees, integrity.risk));
  if (!pose.rotation_valid) {
    table.add(TopicId::kRelativePose, LineStyle::kWarning, "  rotation not observable");
    return;
  }
  const YawPitchRoll angles = yaw_pitch_roll(eigen(pose.rig_from_body));
  table.add(TopicId::kRelativePose, style,
            format("  rig_from_body  yaw %+.3f  pitch %+.3f  roll %+.3f deg", angles.yaw * kDegrees,
                   angles.pitch * kDegrees, angles.roll * kDegrees));
  table.add(TopicId::kRelativePose, style,
            format("  1-sigma        x %.3f  y %.3f  z %.3f deg", sigma(0) * kDegrees, sigma(1) * kDegrees,
                   sigma(2) * kDegrees));
  if (!pose.motion_valid) return;
  const YawPitchRoll turned = yaw_pitch_roll(eigen(pose.motion));
  table.add(
      TopicId::kRelativePose, style,
      format("  since frame %-6llu x %+.4f  y %+.4f  z %+.4f m   yaw %+.3f  pitch %+.3f  roll %+.3f deg",
             static_cast<unsigned long long>(pose.first_frame), pose.motion_m.x, pose.motion_m.y,
             pose.motion_m.z, turned.yaw * kDegrees, turned.pitch * kDegrees, turned.roll * kDegrees));
}

void add_approach(Table& table, const omma_Approach& approach) {
  constexpr std::array kModes = {"not seen", "far", "intermediate", "close"};
  const LineStyle style = approach.valid && approach.seen ? LineStyle::kGood : LineStyle::kWarning;
  table.add(TopicId::kApproach, style,
            format("%-12s %-13s%s", approach.body_name,
                   kModes[std::min<std::size_t>(approach.mode, kModes.size() - 1)],
                   approach.seen ? "" : "   expected"));
  if (!approach.valid) return;
  const omma_Vector3& d = approach.direction;
  const double* covariance = approach.covariance_direction_rad2;
  table.add(TopicId::kApproach, style,
            format("  direction      x %+.5f  y %+.5f  z %+.5f   1-sigma %.1f arcsec", d.x, d.y, d.z,
                   std::sqrt(0.5 * (covariance[0] + covariance[4] + covariance[8])) * kArcseconds));
  if (!approach.range_valid) return;
  table.add(
      TopicId::kApproach, style,
      format("  range          %.3f m   1-sigma %.3f m   rate %+.3f m/s   1-sigma %.3f m/s", approach.range_m,
             approach.range_sigma_m, approach.range_rate_m_s, approach.range_rate_sigma_m_s));
}

void add_objects(Table& table, const omma_UnknownObjects& objects) {
  table.add(TopicId::kUnknownObjects, LineStyle::kPlain,
            format("%u followed   %u candidates   %u dots that nobody claims", objects.objects._length,
                   objects.candidates, objects.leftover_dots));
  if (objects.objects._length == 0) return;
  table.plain("number  motion           RA deg   Dec deg   1-sigma  rate arcmin/s    snr  sightings  missed");
  for (std::uint32_t i = 0; i < objects.objects._length; ++i) {
    const omma_UnknownObject& object = objects.objects._buffer[i];
    const omma_Vector3& d = object.direction;
    const omma_Vector3& v = object.velocity_rad_s;
    const double ra = std::atan2(d.y, d.x) * kDegrees;
    const double* covariance = object.covariance_direction_rad2;
    const double sigma = std::sqrt(0.5 * (covariance[0] + covariance[4] + covariance[8]));
    table.add(TopicId::kUnknownObjects, object.seen ? LineStyle::kGood : LineStyle::kWarning,
              format("%6u  %-14s %8.3f  %+8.3f  %6.1f\"  %13.3f  %5.1f  %9u  %6u", object.number,
                     name_of(object.motion), ra < 0 ? ra + 360 : ra,
                     std::asin(std::clamp(d.z, -1.0, 1.0)) * kDegrees, sigma * kArcseconds,
                     std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) * kArcseconds / 60,
                     static_cast<double>(object.snr), object.sightings, object.missed));
  }
}

void add_health(Table& table, const omma_Health& health) {
  const LineStyle style = health.state == omma_HEALTH_OK         ? LineStyle::kGood
                          : health.state == omma_HEALTH_DEGRADED ? LineStyle::kWarning
                                                                 : LineStyle::kBad;
  auto count = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  table.add(
      TopicId::kHealth, style,
      format("%s   ticks missed %llu   over budget %llu   memory violations %llu", name_of(health.state),
             count(health.ticks_missed), count(health.over_budget), count(health.memory_violations)));
  table.add(TopicId::kHealth, style,
            format("dropped: events %llu, frame sets of telemetry %llu   not logged: %llu samples",
                   count(health.events_dropped), count(health.telemetry_dropped), count(health.log_lost)));
}

void add_motion(Table& table, const omma_Motion& motion) {
  const LineStyle style = motion.board_lost || motion.mode == omma_MOTION_STOPPED ? LineStyle::kBad
                          : motion.late_ticks > 0                                 ? LineStyle::kWarning
                                                                                  : LineStyle::kGood;
  auto count = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  table.add(TopicId::kMotion, style,
            format("%s   %.2f s of the trajectory   late beats %llu   commands refused %llu%s",
                   name_of(motion.mode), motion.trajectory_time_s, count(motion.late_ticks),
                   count(motion.refused_commands), motion.board_lost ? "   BOARD LOST" : ""));
  for (std::uint32_t i = 0; i < motion.axes._length; ++i) {
    const omma_AxisCommand& axis = motion.axes._buffer[i];
    table.add(TopicId::kMotion, style,
              format("  %-10s %+8.3f deg  %+8.3f deg/s  %8.2f us", axis.name, axis.angle_rad * kDegrees,
                     axis.speed_rad_s * kDegrees, axis.pulse_quarter_us / 4.0));
  }
}

const char* name_of(omma_Mode mode) {
  static constexpr const char* kNames[] = {"standby", "acquire", "track", "SAFE"};
  return kNames[static_cast<std::size_t>(mode)];
}

void add_status(Table& table, const omma_Status& status) {
  const LineStyle style = status.mode == omma_MODE_SAFE || status.limits_alarmed > 0 ? LineStyle::kBad
                          : status.limits_warned > 0                                 ? LineStyle::kWarning
                          : status.mode == omma_MODE_TRACK                           ? LineStyle::kGood
                                                                                     : LineStyle::kPlain;
  table.add(
      TopicId::kStatus, style,
      format("mode %s since %.3f s   limits: %u warned, %u in alarm", name_of(status.mode),
             static_cast<double>(status.mode_since_ns) * 1e-9, status.limits_warned, status.limits_alarmed));
  table.add(TopicId::kStatus, LineStyle::kPlain,
            format("commands accepted %u, rejected %u, newest number %u   session %u   untold answers %u",
                   status.commands_accepted, status.commands_rejected, status.last_sequence, status.session,
                   status.acks_dropped));
  table.add(TopicId::kStatus, LineStyle::kPlain,
            format("parameter set %u, %u staged", status.parameter_set, status.parameters_staged));
}

void add_timing(Table& table, const omma_Timing& timing) {
  table.plain("component         steps   mean ms    p99 ms    max ms  budget ms   over");
  for (std::uint32_t i = 0; i < timing.steps._length; ++i) {
    const omma_StepTiming& step = timing.steps._buffer[i];
    auto milliseconds = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
    table.add(TopicId::kTiming, step.over_budget > 0 ? LineStyle::kWarning : LineStyle::kPlain,
              format("%-14s %8llu %9.3f %9.3f %9.3f %10.1f %6llu", step.name,
                     static_cast<unsigned long long>(step.steps), milliseconds(step.mean_ns),
                     milliseconds(step.p99_ns), milliseconds(step.max_ns), milliseconds(step.budget_ns),
                     static_cast<unsigned long long>(step.over_budget)));
  }
}

void add_latency(Table& table, const omma_FrameTiming& timing) {
  table.plain("stage             latency   mean ms    p99 ms    max ms  budget ms   over");
  for (std::uint32_t i = 0; i < timing.stages._length; ++i) {
    const omma_StageTiming& stage = timing.stages._buffer[i];
    auto milliseconds = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
    const bool late = stage.budget_ns > 0 && stage.latency_ns > stage.budget_ns;
    table.add(TopicId::kFrameTiming, late ? LineStyle::kWarning : LineStyle::kPlain,
              format("%-14s %10.3f %9.3f %9.3f %9.3f %10.1f %6llu%s", stage.name,
                     milliseconds(stage.latency_ns), milliseconds(stage.mean_ns), milliseconds(stage.p99_ns),
                     milliseconds(stage.max_ns), milliseconds(stage.budget_ns),
                     static_cast<unsigned long long>(stage.over_budget), stage.reached ? "" : "   left out"));
  }
}

void add_utc(Table& table, const omma_UtcCorrelation& utc) {
  static constexpr const char* kSources[] = {"unknown", "the mission's epoch",
                                             "the system's clock, kept by nothing",
                                             "the system's clock, kept by NTP or PPS"};
  const std::time_t seconds = utc.utc_ns / 1'000'000'000;
  std::tm date{};
  gmtime_r(&seconds, &date);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &date);
  const std::string error = utc.uncertainty_ns < 0
                                ? "error not known"
                                : format("within %.6f s", static_cast<double>(utc.uncertainty_ns) * 1e-9);
  table.add(TopicId::kUtc, utc.valid ? LineStyle::kPlain : LineStyle::kWarning,
            format("UTC %s.%03dZ at on-board time %.3f s, %s (%s)", text.data(),
                   static_cast<int>(utc.utc_ns / 1'000'000 % 1000), static_cast<double>(utc.time_ns) * 1e-9,
                   error.c_str(), kSources[utc.source]));
}

void add_events(Table& table, const std::deque<EventLine>& events) {
  for (const EventLine& event : events) {
    const LineStyle style = event.severity == omma_EVENT_FAILURE   ? LineStyle::kBad
                            : event.severity == omma_EVENT_WARNING ? LineStyle::kWarning
                                                                   : LineStyle::kPlain;
    table.lasting(style, format("%12.3f s  %-10s %s%s", static_cast<double>(event.time_ns) * 1e-9,
                                name_of(event.severity),
                                event.runs_ago > 0 ? format("(%u runs ago) ", event.runs_ago).c_str() : "",
                                event.text.c_str()));
  }
}

}  // namespace

std::vector<TableLine> monitor_table(const NewestSamples& samples, const LinkState& link,
                                     SteadyClock::time_point now) {
  Table table(samples, now);
  table.plain(link.spacecraft.empty()
                  ? format("no spacecraft heard yet in domain %d", link.domain)
                  : format("%s, domain %d   %.1f frame sets/s   %llu samples lost", link.spacecraft.c_str(),
                           link.domain, samples.frame_rate(), static_cast<unsigned long long>(link.lost)));
  table.heading("STATUS", TopicId::kStatus);
  if (samples.status() != nullptr) add_status(table, *samples.status());
  table.heading("CAMERAS", TopicId::kFrameSet);
  if (samples.frame_set() != nullptr) add_cameras(table, *samples.frame_set());
  table.heading("ATTITUDE", TopicId::kAttitude);
  if (samples.attitude() != nullptr) add_attitude(table, *samples.attitude());
  table.heading("POSES", TopicId::kRelativePose);
  for (const auto& [body, pose] : samples.poses()) add_pose(table, pose);
  if (!samples.approaches().empty()) table.heading("APPROACH", TopicId::kApproach);
  for (const auto& [body, approach] : samples.approaches()) add_approach(table, approach);
  table.heading("OBJECTS", TopicId::kUnknownObjects);
  if (samples.objects() != nullptr) add_objects(table, *samples.objects());
  if (const omma_Motion* motion = samples.motion()) {
    table.heading("MOTION", TopicId::kMotion);
    add_motion(table, *motion);
  }
  table.heading("HEALTH", TopicId::kHealth);
  if (samples.health() != nullptr) add_health(table, *samples.health());
  table.heading("TIMING", TopicId::kTiming);
  if (samples.timing() != nullptr) add_timing(table, *samples.timing());
  table.heading("LATENCY", TopicId::kFrameTiming);
  if (samples.frame_timing() != nullptr) add_latency(table, *samples.frame_timing());
  table.heading("TIME", TopicId::kUtc);
  if (samples.utc() != nullptr) add_utc(table, *samples.utc());
  table.heading("IMAGE", TopicId::kImageChunk);
  if (const omma_ImageChunk* chunk = samples.image_chunk())
    table.add(TopicId::kImageChunk, LineStyle::kPlain,
              format("image %u   %u x %u px   rows to %u", chunk->image, chunk->width_px, chunk->height_px,
                     chunk->first_row + chunk->rows));
  table.heading("EVENTS", TopicId::kEvent, true);
  add_events(table, samples.events());
  return table.take();
}

}  // namespace omma::ground
