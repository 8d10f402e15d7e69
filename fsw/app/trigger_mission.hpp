// The part of a mission that fires the cameras, and the line it names.
#pragma once

#include <cstdint>
#include <memory>

#include "components/camera/trigger_matching.hpp"
#include "fsw/app/run_options.hpp"
#include "fsw/services/toml_table.hpp"
#include "hal/gpiod/gpiod_trigger.hpp"
#include "hal/servo.hpp"
#include "hal/trigger.hpp"

namespace omma {

struct Mission;

enum class TriggerKind : std::uint8_t {
  kRecorded,   ///< frames come with the numbers of their triggers: nothing is fired
  kSimulated,  ///< a line that is not there
  kGpiod,      ///< a line of a GPIO chip
  kMaestro,    ///< a channel of the servo board that [motion] names
};

struct TriggerMission {
  TriggerKind driver = TriggerKind::kRecorded;
  GpiodOptions gpiod;
  int channel = 0;  ///< of the servo board
  TriggerMatchOptions matching;
};

/// The mission's [trigger] table; a pulse goes out with every frame set:
///
///   driver = "gpiod"           # or "recorded", "simulated", "maestro"
///   chip = "gpiochip0"         # name, path or label; with gpiod
///   line = "frame_sync"        # name or number; with gpiod
///   channel = 11               # of the servo board, set up as an output; with maestro
///   width_ms = 1.0             # less than the period of the frame sets
///   polarity = "rising"        # of the leading edge; or "falling"
///   stamp_delay_ms = 12        # from the edge to a frame's time stamp; left out: as with the first frame
///
/// @throws InputError naming file, line and field
TriggerMission read_trigger(const TomlTable& table, double frame_rate_hz);

/// True where a real line is fired: such a mission keeps real time.
bool has_trigger_line(const Mission& mission);

/// The trigger line of a mission; null where nothing is fired. Without devices (RunOptions::with_cameras) a
/// simulated one.
/// @param servo  the servo board, for a trigger on one of its channels; it outlives the driver
/// @throws InputError where the line cannot be had, or in a replay, whose time no camera can follow
std::unique_ptr<TriggerDriver> trigger_driver(const Mission& mission, const RunOptions& options,
                                              ServoDriver* servo);

}  // namespace omma
