// Staging and committing.
#include "fsw/services/parameters.hpp"

namespace omma {

void add_entries(std::vector<ParameterEntry>& entries, const ParameterDescriptor& parameter,
                 const std::vector<double>& initial, const std::vector<std::string>& instances) {
  for (std::size_t i = 0; i < initial.size() && i < parameter.instances; ++i) {
    std::string name(parameter.name);
    if (i < instances.size()) name += "." + instances[i];
    entries.push_back(
        {static_cast<std::uint16_t>(parameter.id + i), name, parameter.value, initial[i], parameter.text});
  }
}

Parameters::Parameters(std::vector<ParameterEntry> entries, Events& events)
    : entries_(std::move(entries)), events_(events) {
  entry_of_.fill(-1);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    entry_of_[entries_[i].id] = static_cast<std::int16_t>(i);
    committed->values[entries_[i].id] = entries_[i].initial;
  }
  staged_ = *committed;
}

void Parameters::start_from(const ParameterSet& saved) {
  *committed = saved;
  staged_ = saved;
  state->set = saved.number;
}

void Parameters::visit_ports(PortVisitor& visitor) const {
  visitor.output("committed", committed);
  visitor.output("state", state);
}

void Parameters::step(const Tick& tick) noexcept {
  if (commit_) {
    const std::uint32_t number = committed->number + 1;
    events_.raise<kParametersCommitted>(tick, number, staged_count());
    staged_.number = number;
    *committed = staged_;
    commit_ = false;
    to_store_.back() = staged_;
    to_store_.publish();
  }
  state->set = committed->number;
  state->staged = staged_count();
}

std::uint16_t Parameters::staged_count() const noexcept {
  std::uint16_t count = 0;
  for (const ParameterEntry& entry : entries_)
    if (staged_.values[entry.id] != committed->values[entry.id]) ++count;
  return count;
}

const ParameterEntry* Parameters::find(double id) const noexcept {
  if (!(id >= 0 && id < static_cast<double>(entry_of_.size()))) return nullptr;
  const std::int16_t at = entry_of_[static_cast<std::size_t>(id)];
  return at < 0 ? nullptr : &entries_[static_cast<std::size_t>(at)];
}

CommandOutcome Parameters::receive(const Command& command, const Tick& /*tick*/) noexcept {
  switch (command.opcode) {
    case kSetParameter.id:
      return stage(command);
    case kCommitParameters.id:
      commit_ = true;  // in its own step, which comes before those of its users
      return stored_ ? CommandOutcome::under_way() : CommandOutcome::done();
    case kMissionParameters.id:
      for (const ParameterEntry& entry : entries_) staged_.values[entry.id] = entry.initial;
      return CommandOutcome::done();
    default:  // kDiscardParameters
      staged_ = *committed;
      return CommandOutcome::done();
  }
}

CommandOutcome Parameters::stage(const Command& command) noexcept {
  const ParameterEntry* entry = find(command.arguments[0]);
  if (entry == nullptr) return CommandOutcome::refused(CommandReason::kArgumentRange, 0);
  switch (judge(entry->value, command.arguments[1])) {
    case ValueFault::kType:
      return CommandOutcome::refused(CommandReason::kArgumentType, 1);
    case ValueFault::kRange:
      return CommandOutcome::refused(CommandReason::kArgumentRange, 1);
    case ValueFault::kNone:
      break;
  }
  staged_.values[entry->id] = command.arguments[1];
  return CommandOutcome::done();
}

// Commits of one beat are one set, and each waits for the newest: what holds the newest holds them all.
CommandOutcome Parameters::progress(const Command& /*command*/) noexcept {
  const std::uint32_t number = committed->number;
  if (saved_.load(std::memory_order_acquire) >= number) return CommandOutcome::done();
  if (not_saved_.load(std::memory_order_acquire) >= number)
    return CommandOutcome::failed(CommandReason::kNotSaved);
  return CommandOutcome::under_way();
}

bool Parameters::take_for_saving(ParameterSet& set) noexcept {
  if (!to_store_.acquire()) return false;
  set = to_store_.front();
  return true;
}

void Parameters::saved(std::uint32_t number, bool well) noexcept {
  (well ? saved_ : not_saved_).store(number, std::memory_order_release);
}

}  // namespace omma
