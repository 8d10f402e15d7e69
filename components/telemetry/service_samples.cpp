// What the services say, field by field into the structs of the IDL: health, timing, time, commands,
// parameters.
#include <algorithm>

#include "components/telemetry/idl_enumerations.hpp"
#include "components/telemetry/samples.hpp"

namespace omma::telemetry {

void fill(const HealthReport& health, omma_Health& out) noexcept {
  out.time_ns = health.time_ns;
  out.valid = health.valid;
  out.state = same<omma_HealthState>(health.state);
  out.ticks_missed = health.ticks_missed;
  out.over_budget = health.over_budget;
  out.memory_violations = health.memory_violations;
  out.events_dropped = health.events_dropped;
  out.groups._length = static_cast<std::uint32_t>(health.groups.size());
  std::transform(health.groups.begin(), health.groups.end(), out.groups._buffer,
                 [](const GroupHealth& group) {
                   return omma_GroupHealth{group.beats, group.missed, group.stopped};
                 });
}

void fill(const TimingReport& timing, omma_Timing& out) noexcept {
  out.time_ns = timing.time_ns;
  out.valid = timing.valid;
  out.steps._length = static_cast<std::uint32_t>(timing.steps.size());
  for (std::size_t i = 0; i < timing.steps.size(); ++i) {
    const StepTiming& step = timing.steps[i];
    omma_StepTiming& to = out.steps._buffer[i];
    set_text(to.name, step.name);
    to.steps = step.steps;
    to.last_ns = step.last_ns;
    to.mean_ns = step.mean_ns;
    to.max_ns = step.max_ns;
    to.p99_ns = step.p99_ns;
    to.cpu_mean_ns = step.cpu_mean_ns;
    to.cpu_max_ns = step.cpu_max_ns;
    to.budget_ns = step.budget_ns;
    to.over_budget = step.over_budget;
  }
}

void fill(const UtcReport& utc, omma_UtcCorrelation& out) noexcept {
  out.time_ns = utc.time_ns;
  out.valid = utc.valid;
  out.source = same<omma_UtcSource>(utc.source);
  out.utc_ns = utc.utc_ns;
  out.uncertainty_ns = utc.uncertainty_ns;
}

void fill(const CommandAck& ack, omma_CommandAck& out) noexcept {
  out.time_ns = ack.time_ns;
  out.valid = true;
  out.sender = ack.command.sender;
  out.session = ack.command.session;
  out.sequence_number = ack.command.sequence;
  out.opcode = ack.command.opcode;
  out.stage = same<omma_CommandStage>(ack.stage);
  out.reason = same<omma_CommandReason>(ack.reason);
  out.argument = ack.argument;
}

void fill(const SpacecraftStatus& status, omma_Status& out) noexcept {
  out.mode = same<omma_Mode>(status.mode.mode);
  out.mode_since_ns = status.mode.since_ns;
  out.limits_warned = status.limits.warned;
  out.limits_alarmed = status.limits.alarmed;
  out.parameter_set = status.parameters.set;
  out.parameters_staged = status.parameters.staged;
  out.session = status.commands.session;
  out.last_sequence = status.commands.last_sequence;
  out.commands_accepted = status.commands.accepted;
  out.commands_rejected = status.commands.rejected;
  out.acks_dropped = status.commands.acks_dropped;
}

void fill(const ParameterSet& set, std::span<const ParameterEntry> entries, omma_Parameters& out) noexcept {
  out.parameter_set = set.number;
  const std::size_t count = std::min<std::size_t>(entries.size(), out.values._maximum);
  out.values._length = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) out.values._buffer[i] = {entries[i].id, set.values[entries[i].id]};
}

}  // namespace omma::telemetry
