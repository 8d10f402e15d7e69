#include "fsw/app/motion_mission.hpp"

#include <cmath>

#include "components/motion/motion_files.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/app/recorded_motion_file.hpp"
#include "hal/simulated/simulated_servo.hpp"

namespace omma {
namespace {

constexpr double kUsualRate = 200;  // [Hz]

ServoKind read_kind(const TomlTable& table) {
  const std::string driver = table.text("driver");
  if (driver == "recorded") return ServoKind::kRecorded;
  if (driver == "simulated") return ServoKind::kSimulated;
  if (driver == "maestro") return ServoKind::kMaestro;
  throw table.error("driver", "\"recorded\", \"simulated\" or \"maestro\"", driver);
}

std::uint32_t read_beats(const TomlTable& table, double frame_rate_hz) {
  const double rate = table.number("rate_hz", {1, 1000}, kUsualRate);
  const double beats = rate / frame_rate_hz;
  constexpr double kRounding = 1e-6;
  if (beats < 1 - kRounding || std::abs(beats - std::round(beats)) > kRounding * beats)
    throw table.error("rate_hz", "a whole multiple of frame_rate_hz, " + std::to_string(frame_rate_hz),
                      std::to_string(rate));
  return static_cast<std::uint32_t>(std::lround(beats));
}

}  // namespace

TimeNs MotionMission::period_ns() const {
  return std::llround(1e9 / frame_rate_hz / beats_per_frame_set);
}

MotionMission read_motion(const TomlTable& table, double frame_rate_hz) {
  MotionMission motion;
  motion.driver = read_kind(table);
  // A device may be named whatever the driver, so that one word switches it off.
  motion.maestro.device = table.text("device", "");
  motion.maestro.number = static_cast<int>(table.integer("device_number", {0, 127}, -1));
  motion.maestro.channels = static_cast<int>(table.integer("channels", {1, maestro::kMaxChannels}, 12));
  if (motion.driver == ServoKind::kMaestro && motion.maestro.device.empty())
    throw table.error("device", "the serial line of the Maestro", "nothing");
  motion.frame_rate_hz = frame_rate_hz;
  motion.beats_per_frame_set = read_beats(table, frame_rate_hz);
  const std::vector<GimbalAxis> gimbal = read_gimbal_file(table.path("gimbal"));
  for (const GimbalAxis& axis : gimbal)
    if (axis.channel >= motion.maestro.channels)
      throw table.error("channels", "the channel of every axis, up to " + std::to_string(axis.channel),
                        std::to_string(motion.maestro.channels));
  motion.axes = read_trajectory_file(table.path("trajectory"), gimbal);
  // As the device: may stay, so that one word switches.
  const std::string recording = table.text("recording", "");
  if (motion.driver == ServoKind::kRecorded) {
    if (recording.empty())
      throw table.error("recording", "a flight's recording (.mcap) or a table (.csv) of what the axes did",
                        "nothing");
    motion.recorded = read_recorded_motion(table.path("recording"), gimbal);
  }
  table.refuse_unknown_keys();
  return motion;
}

bool has_servo_board(const Mission& mission) {
  return mission.motion && mission.motion->driver == ServoKind::kMaestro;
}

std::unique_ptr<ServoDriver> servo_driver(const Mission& mission, const RunOptions& options) {
  if (!mission.motion || mission.motion->driver == ServoKind::kRecorded) return nullptr;
  if (mission.motion->driver == ServoKind::kSimulated || !options.with_cameras)
    return std::make_unique<SimulatedServo>();
  if (options.lockstep)
    throw InputError(mission.file, 0, "motion.driver",
                     "\"recorded\" or \"simulated\" in a replay, or --real-time", "maestro");
  return std::make_unique<MaestroServo>(mission.motion->maestro);
}

}  // namespace omma
