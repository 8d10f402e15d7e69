// The parameter service: values are staged by command, one after the other, and take effect together when
// they are committed, at the beginning of a beat. A committed set crosses to an ordinary thread that saves it
// (ParameterStore); the commit's command is completed when the set is safe, or fails and says so.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/kernel/triple_buffer.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

inline constexpr CommandDescriptor kSetParameter{
    .id = 2,
    .name = "set_parameter",
    .text = "stages a value; nothing changes before the commit",
    .arguments = {{{.name = "parameter", .type = ValueType::kParameter},
                   {.name = "value", .least = -1e300, .most = 1e300}}}};
inline constexpr CommandDescriptor kCommitParameters{
    .id = 3,
    .name = "commit_parameters",
    .text = "puts all staged values in force with the next beat, and saves them"};
inline constexpr CommandDescriptor kDiscardParameters{
    .id = 4, .name = "discard_parameters", .text = "forgets the staged values"};
inline constexpr CommandDescriptor kMissionParameters{
    .id = 5, .name = "mission_parameters", .text = "stages the mission's values for all parameters"};

inline constexpr std::array kParameterCommands{kSetParameter, kCommitParameters, kDiscardParameters,
                                               kMissionParameters};

inline constexpr EventDescriptor kParametersCommitted{
    .id = 60,
    .severity = EventSeverity::kActivity,
    .name = "parameters_committed",
    .text = "parameter set {0} is in force, with {1} values changed",
    .values = {{{"set"}, {"changed"}}}};

inline constexpr std::array kParameterEvents{kParametersCommitted};
static_assert(are_unique(kParameterEvents) && are_well_formed(kParameterEvents));

/// What telemetry tells of them.
struct ParameterState {
  std::uint32_t set = 0;     ///< the set in force
  std::uint16_t staged = 0;  ///< values that differ from it
  friend bool operator==(const ParameterState&, const ParameterState&) = default;
};

class Parameters final : public Component, public CommandReceiver {
 public:
  /// @param entries  one an id; their initial values are in force until told otherwise
  Parameters(std::vector<ParameterEntry> entries, Events& events);

  /// Before time starts: another set in force, with the number it was saved under.
  void start_from(const ParameterSet& saved);
  /// Before time starts: from now on a commit is done when `saved` says so.
  void use_store() { stored_ = true; }

  Out<ParameterSet> committed;
  Out<ParameterState> state;

  std::string_view name() const override { return "parameters"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;
  CommandOutcome progress(const Command& command) noexcept override;

  std::span<const ParameterEntry> entries() const { return entries_; }

  // The store's thread: the newest set to save, and what became of it.
  bool take_for_saving(ParameterSet& set) noexcept;
  void saved(std::uint32_t number, bool well) noexcept;

 private:
  const ParameterEntry* find(double id) const noexcept;
  CommandOutcome stage(const Command& command) noexcept;
  std::uint16_t staged_count() const noexcept;

  std::vector<ParameterEntry> entries_;
  std::array<std::int16_t, limits::kParameterIds> entry_of_{};  // by id; −1: none
  Events& events_;
  ParameterSet staged_;
  bool commit_ = false;
  bool stored_ = false;
  TripleBuffer<ParameterSet> to_store_;
  std::atomic<std::uint32_t> saved_{0};
  std::atomic<std::uint32_t> not_saved_{0};
};

}  // namespace omma
