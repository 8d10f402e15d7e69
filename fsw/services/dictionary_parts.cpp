#include "fsw/services/dictionary_parts.hpp"

#include <cmath>

namespace omma {
namespace {

std::string_view type_name(ValueType type) {
  switch (type) {
    case ValueType::kNumber:
      return "number";
    case ValueType::kInteger:
      return "integer";
    case ValueType::kFlag:
      return "flag";
    case ValueType::kChoice:
      return "choice";
    case ValueType::kParameter:
      return "parameter";
  }
  return "unknown";
}

// What a value may be, inside the object that names it.
void write_range(JsonText& json, const ValueDescriptor& value) {
  json.key("unit").string(value.unit).key("type").string(type_name(value.type));
  if (value.type == ValueType::kChoice) {
    write_choices(json, value.choices);
  } else if (value.type == ValueType::kNumber || value.type == ValueType::kInteger) {
    json.key("least").number(value.least).key("most").number(value.most);
  }
}

void write_command(JsonText& json, const CommandDescriptor& command) {
  json.open_object().key("opcode").number(command.id).key("name").string(command.name);
  json.key("text").string(command.text).key("arguments").open_array();
  for (std::size_t i = 0; i < command.argument_count(); ++i) {
    json.open_object().key("name").string(command.arguments[i].name);
    write_range(json, command.arguments[i]);
    json.close_object();
  }
  json.close_array();
  if (command.modes != kAnyMode) write_modes(json, "modes", command.modes);
  json.close_object();
}

void write_parameter(JsonText& json, const ParameterEntry& entry) {
  json.open_object().key("id").number(entry.id).key("name").string(entry.name);
  json.key("text").string(entry.text);
  write_range(json, entry.value);
  json.key("initial").number(entry.initial).close_object();
}

void write_channel(JsonText& json, const ChannelDescriptor& channel) {
  json.open_object().key("id").number(channel.id).key("name").string(channel.name);
  json.key("unit").string(channel.unit).key("text").string(channel.text).close_object();
}

std::string_view channel_name(const Dictionary& dictionary, std::uint16_t id) {
  for (const ChannelDescriptor& channel : dictionary.channels)
    if (channel.id == id) return channel.name;
  return "always";
}

void write_limit(JsonText& json, const Dictionary& dictionary, const LimitDescriptor& limit) {
  json.open_object().key("id").number(limit.id).key("name").string(limit.name);
  json.key("channel").string(channel_name(dictionary, limit.channel));
  const auto bound = [&json](std::string_view key, double value) {
    if (std::isfinite(value)) json.key(key).number(value);
  };
  bound("alarm_low", limit.alarm_low);
  bound("warning_low", limit.warning_low);
  bound("warning_high", limit.warning_high);
  bound("alarm_high", limit.alarm_high);
  json.key("hysteresis").number(limit.hysteresis).key("beats").number(limit.beats).close_object();
}

void write_condition(JsonText& json, const Dictionary& dictionary, const Condition& condition) {
  static constexpr std::string_view kSigns[] = {"<", ">", "="};
  json.key("when").open_object().key("channel").string(channel_name(dictionary, condition.channel));
  if (condition.channel != 0)
    json.key("is")
        .string(kSigns[static_cast<std::size_t>(condition.comparison)])
        .key("value")
        .number(condition.value);
  json.key("beats").number(condition.beats).close_object();
}

void write_transition(JsonText& json, const Dictionary& dictionary, const ModeTransition& transition) {
  json.open_object();
  write_modes(json, "from", transition.from);
  json.key("to").string(choice_name(kModeNames, static_cast<int>(transition.to)));
  json.key("commanded").boolean(transition.commanded).key("text").string(transition.text);
  write_condition(json, dictionary, transition.when);
  json.close_object();
}

void write_fault_rule(JsonText& json, const Dictionary& dictionary, const FaultRule& rule) {
  static constexpr std::string_view kReactions[] = {"tell", "safe", "command"};
  json.open_object().key("id").number(rule.id).key("name").string(rule.name).key("text").string(rule.text);
  if (rule.in != kAnyMode) write_modes(json, "modes", rule.in);
  write_condition(json, dictionary, rule.when);
  json.key("reaction").string(kReactions[static_cast<std::size_t>(rule.reaction)]);
  if (rule.command != 0) json.key("opcode").number(rule.command);
  json.close_object();
}

}  // namespace

void write_choices(JsonText& json, std::string_view choices) {
  json.key("choices").open_array();
  for (int i = 0; i < choice_count(choices); ++i) json.string(choice_name(choices, i));
  json.close_array();
}

void write_modes(JsonText& json, std::string_view key, ModeSet set) {
  json.key(key).open_array();
  for (int mode = 0; mode < kModeCount; ++mode)
    if (contains(set, static_cast<Mode>(mode))) json.string(choice_name(kModeNames, mode));
  json.close_array();
}

void write_operations(JsonText& json, const Dictionary& dictionary) {
  json.key("commands").open_array();
  for (const CommandDescriptor& command : dictionary.commands) write_command(json, command);
  json.close_array().key("parameters").open_array();
  for (const ParameterEntry& entry : dictionary.parameters) write_parameter(json, entry);
  json.close_array().key("channels").open_array();
  for (const ChannelDescriptor& channel : dictionary.channels) write_channel(json, channel);
  json.close_array().key("limits").open_array();
  for (const LimitDescriptor& limit : dictionary.limits) write_limit(json, dictionary, limit);
  json.close_array().key("mode_transitions").open_array();
  for (const ModeTransition& transition : dictionary.transitions)
    write_transition(json, dictionary, transition);
  json.close_array().key("fault_rules").open_array();
  for (const FaultRule& rule : dictionary.fault_rules) write_fault_rule(json, dictionary, rule);
  json.close_array();
}

}  // namespace omma
