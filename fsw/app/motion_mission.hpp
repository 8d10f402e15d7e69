// The part of a mission that moves a gimbal, and the servo board it names.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "components/motion/axis.hpp"
#include "components/motion/recorded_motion.hpp"
#include "fsw/app/run_options.hpp"
#include "fsw/kernel/tick.hpp"
#include "fsw/services/toml_table.hpp"
#include "hal/maestro/maestro_servo.hpp"
#include "hal/servo.hpp"

namespace omma {

struct Mission;

enum class ServoKind : std::uint8_t {
  kRecorded,   ///< the axes moved when the frames were recorded: what they did is told, nothing is commanded
  kSimulated,  ///< no board: the axes are told, and nothing moves
  kMaestro,
};

struct MotionMission {
  ServoKind driver = ServoKind::kSimulated;
  MaestroOptions maestro;
  std::vector<MotionAxis> axes;
  RecordedMotion recorded;  ///< of recorded axes
  std::uint32_t beats_per_frame_set = 0;
  double frame_rate_hz = 0;

  /// Of the motion's rate group [ns].
  TimeNs period_ns() const;
};

/// The mission's [motion] table:
///
///   driver = "maestro"            # or "simulated", "recorded"
///   device = "/dev/ttyACM0"       # these three of a Maestro only
///   device_number = 12            # in Pololu's protocol; left out: compact, one board on the line
///   channels = 12
///   gimbal = "gimbals/dissertation.toml"
///   trajectory = "trajectories/turn.csv"
///   rate_hz = 200                 # commands to each axis; a whole multiple of the frame rate
///   recording = "flight.mcap"     # of recorded axes only: what they did
///
/// @throws InputError naming file, line and field
MotionMission read_motion(const TomlTable& table, double frame_rate_hz);

/// True where a real board moves: such a mission keeps real time.
bool has_servo_board(const Mission& mission);

/// The servo board of a mission; null where nothing is commanded. Without devices (RunOptions::with_cameras)
/// a simulated one.
/// @throws InputError where the device is not usable, or in a replay, whose time no servo can follow
std::unique_ptr<ServoDriver> servo_driver(const Mission& mission, const RunOptions& options);

}  // namespace omma
