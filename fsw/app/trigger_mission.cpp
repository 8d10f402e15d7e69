#include "fsw/app/trigger_mission.hpp"

#include <cmath>
#include <string>

#include "fsw/app/mission.hpp"
#include "hal/maestro/maestro_trigger.hpp"
#include "hal/simulated/simulated_trigger.hpp"

namespace omma {
namespace {

constexpr int kPulseEndPriority = 85;  // above every rate group: a pulse that is due to end, ends
constexpr double kMilliseconds = 1e6;  // in nanoseconds

TriggerKind read_kind(const TomlTable& table) {
  const std::string driver = table.text("driver");
  if (driver == "recorded") return TriggerKind::kRecorded;
  if (driver == "simulated") return TriggerKind::kSimulated;
  if (driver == "gpiod") return TriggerKind::kGpiod;
  if (driver == "maestro") return TriggerKind::kMaestro;
  throw table.error("driver", "\"recorded\", \"simulated\", \"gpiod\" or \"maestro\"", driver);
}

TriggerPulse read_pulse(const TomlTable& table, double period_ms) {
  TriggerPulse pulse;
  const double width = table.number("width_ms", {0.01, 10000}, std::min(1.0, period_ms / 2));
  if (!(width < period_ms))
    throw table.error("width_ms",
                      "less than the period of the frame sets, " + std::to_string(period_ms) + " ms",
                      std::to_string(width) + " ms");
  pulse.width_ns = std::llround(width * kMilliseconds);
  const std::string polarity = table.text("polarity", "rising");
  if (polarity != "rising" && polarity != "falling")
    throw table.error("polarity", "\"rising\" or \"falling\"", polarity);
  pulse.active_low = polarity == "falling";
  return pulse;
}

}  // namespace

TriggerMission read_trigger(const TomlTable& table, double frame_rate_hz) {
  const double period_ms = 1000 / frame_rate_hz;
  TriggerMission trigger;
  trigger.driver = read_kind(table);
  // What belongs to another driver may stay, so that one word switches between them.
  trigger.gpiod.chip = table.text("chip", "");
  trigger.gpiod.line = table.text("line", "");
  const bool has_channel = table.has("channel");
  trigger.channel = static_cast<int>(table.integer("channel", {0, maestro::kMaxChannels - 1}, 0));
  trigger.gpiod.pulse = read_pulse(table, period_ms);
  trigger.gpiod.priority = kPulseEndPriority;
  trigger.matching.tolerance_ns = std::llround(period_ms / 4 * kMilliseconds);
  if (table.has("stamp_delay_ms"))
    trigger.matching.delay_ns = std::llround(table.number("stamp_delay_ms", {0, 10000}) * kMilliseconds);
  if (trigger.driver == TriggerKind::kGpiod) {
    if (trigger.gpiod.chip.empty())
      throw table.error("chip", "a GPIO chip, by name, path or label", "nothing");
    if (trigger.gpiod.line.empty())
      throw table.error("line", "a line of the chip, by number or name", "nothing");
  }
  if (trigger.driver == TriggerKind::kMaestro && !has_channel)
    throw table.error("channel", "the channel of the servo board that is an output", "nothing");
  table.refuse_unknown_keys();
  return trigger;
}

bool has_trigger_line(const Mission& mission) {
  return mission.trigger.driver == TriggerKind::kGpiod || mission.trigger.driver == TriggerKind::kMaestro;
}

std::unique_ptr<TriggerDriver> trigger_driver(const Mission& mission, const RunOptions& options,
                                              ServoDriver* servo) {
  const TriggerMission& trigger = mission.trigger;
  if (trigger.driver == TriggerKind::kRecorded) return nullptr;
  if (trigger.driver == TriggerKind::kSimulated || !options.with_cameras)
    return std::make_unique<SimulatedTrigger>();
  if (options.lockstep)
    throw InputError(mission.file, 0, "trigger.driver",
                     "\"recorded\" or \"simulated\" in a replay, or --real-time",
                     trigger.driver == TriggerKind::kGpiod ? "gpiod" : "maestro");
  if (trigger.driver == TriggerKind::kGpiod) return std::make_unique<GpiodTrigger>(trigger.gpiod);
  auto* board = dynamic_cast<MaestroServo*>(servo);
  if (board == nullptr)
    throw InputError(mission.file, 0, "trigger.driver",
                     "[motion] with the driver \"maestro\", whose board it shares", "none");
  return std::make_unique<MaestroTrigger>(*board, trigger.channel, trigger.gpiod.pulse, kPulseEndPriority);
}

}  // namespace omma
