// Words to numbers and back.
#include "fsw/services/command_text.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

std::string number_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

const CommandDescriptor* find_command(const CommandVocabulary& vocabulary, std::uint16_t opcode) {
  const auto found =
      std::find_if(vocabulary.commands.begin(), vocabulary.commands.end(),
                   [opcode](const CommandDescriptor& command) { return command.id == opcode; });
  return found == vocabulary.commands.end() ? nullptr : &*found;
}

const ParameterEntry* find_parameter(const CommandVocabulary& vocabulary, double id) {
  const auto found = std::find_if(vocabulary.parameters.begin(), vocabulary.parameters.end(),
                                  [id](const ParameterEntry& entry) { return entry.id == id; });
  return found == vocabulary.parameters.end() ? nullptr : &*found;
}

/// The declaration of value `i`: a value that follows the name of a parameter is that parameter's.
ValueDescriptor declaration(const CommandVocabulary& vocabulary, const CommandDescriptor& command,
                            std::size_t i, const Command& values) {
  if (i > 0 && command.arguments[i - 1].type == ValueType::kParameter) {
    if (const ParameterEntry* entry = find_parameter(vocabulary, values.arguments[i - 1])) {
      ValueDescriptor value = entry->value;
      value.name = command.arguments[i].name;
      return value;
    }
  }
  return command.arguments[i];
}

/// None where the word is nothing of this type at all.
std::optional<double> value_of(std::string_view word, const ValueDescriptor& value,
                               const CommandVocabulary& vocabulary) {
  switch (value.type) {
    case ValueType::kFlag:
      if (word == "true" || word == "on" || word == "1") return 1;
      if (word == "false" || word == "off" || word == "0") return 0;
      return std::nullopt;
    case ValueType::kChoice:
      for (int i = 0; i < choice_count(value.choices); ++i)
        if (choice_name(value.choices, i) == word) return i;
      return std::nullopt;
    case ValueType::kParameter:
      for (const ParameterEntry& entry : vocabulary.parameters)
        if (entry.name == word) return entry.id;
      return std::nullopt;
    default:
      return finite_number(word);
  }
}

std::string word_of(double number, const ValueDescriptor& value, const CommandVocabulary& vocabulary) {
  if (judge(value, number) == ValueFault::kNone) {
    if (value.type == ValueType::kFlag) return number != 0 ? "true" : "false";
    if (value.type == ValueType::kChoice)
      return std::string(choice_name(value.choices, static_cast<int>(number)));
  }
  if (value.type == ValueType::kParameter)
    if (const ParameterEntry* entry = find_parameter(vocabulary, number)) return entry->name;
  return number_text(number);
}

std::string reason_text(const CommandAck& ack, const CommandVocabulary& vocabulary) {
  const CommandDescriptor* declared = find_command(vocabulary, ack.command.opcode);
  const std::size_t at = std::min<std::size_t>(ack.argument, ack.command.arguments.size() - 1);
  switch (ack.reason) {
    case CommandReason::kNone:
      return {};
    case CommandReason::kSession:
      return "it is meant for another run of the flight program";
    case CommandReason::kSequenceRepeated:
      return "sequence number " + std::to_string(ack.command.sequence) + " was judged before";
    case CommandReason::kSequenceAhead:
      return "sequence number " + std::to_string(ack.command.sequence) + " is too far ahead";
    case CommandReason::kOpcode:
      return "there is no command " + std::to_string(ack.command.opcode);
    case CommandReason::kArgumentCount:
      return "it has " + std::to_string(ack.command.argument_count) + " values, and takes " +
             std::to_string(declared == nullptr ? 0 : declared->argument_count());
    case CommandReason::kArgumentType:
    case CommandReason::kArgumentRange: {
      if (declared == nullptr) return "a value is out of its range";
      const ValueDescriptor value = declaration(vocabulary, *declared, at, ack.command);
      return std::string(value.name) + " is " + number_text(ack.command.arguments[at]) + ", and must be " +
             allowed_text(value);
    }
    case CommandReason::kMode:
      return "not in the present mode";
    case CommandReason::kBusy:
      return "what was asked before is not finished";
    case CommandReason::kRefused:
      return "its receiver's condition is not met";
    case CommandReason::kNotSaved:
      return "done, but it could not be saved: it will be lost at the next start";
  }
  return "for an unknown reason";
}

}  // namespace

std::string allowed_text(const ValueDescriptor& value) {
  switch (value.type) {
    case ValueType::kFlag:
      return "true or false";
    case ValueType::kChoice: {
      std::string text(value.choices);
      std::replace(text.begin(), text.end(), '|', ' ');
      return "one of " + text;
    }
    case ValueType::kParameter:
      return "the name of a parameter";
    default: {
      std::string text = (value.type == ValueType::kInteger ? "a whole number " : "a number ") +
                         number_text(value.least) + " to " + number_text(value.most);
      if (!value.unit.empty()) text.append(" ").append(value.unit);
      return text;
    }
  }
}

Command command_from_words(std::span<const std::string_view> words, const CommandVocabulary& vocabulary,
                           std::string_view file, int line) {
  if (words.empty()) throw InputError(file, line, "command", "the name of a command", "nothing");
  const auto declared =
      std::find_if(vocabulary.commands.begin(), vocabulary.commands.end(),
                   [&](const CommandDescriptor& command) { return command.name == words[0]; });
  if (declared == vocabulary.commands.end())
    throw InputError(file, line, "command", "the name of a command", excerpt(words[0]));
  const std::size_t count = declared->argument_count();
  if (words.size() - 1 != count)
    throw InputError(file, line, declared->name, std::to_string(count) + (count == 1 ? " value" : " values"),
                     std::to_string(words.size() - 1));
  Command command{.opcode = declared->id, .argument_count = static_cast<std::uint8_t>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    const ValueDescriptor value = declaration(vocabulary, *declared, i, command);
    const std::optional<double> number = value_of(words[i + 1], value, vocabulary);
    if (!number)
      throw InputError(file, line, std::string(declared->name) + " " + std::string(value.name),
                       allowed_text(value), excerpt(words[i + 1]));
    command.arguments[i] = *number;
  }
  return command;
}

std::string command_text(const Command& command, const CommandVocabulary& vocabulary) {
  const CommandDescriptor* declared = find_command(vocabulary, command.opcode);
  std::string text =
      declared != nullptr ? std::string(declared->name) : "command " + std::to_string(command.opcode);
  const std::size_t count = std::min<std::size_t>(command.argument_count, command.arguments.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool known = declared != nullptr && i < declared->argument_count();
    text += " " +
            (known ? word_of(command.arguments[i], declaration(vocabulary, *declared, i, command), vocabulary)
                   : number_text(command.arguments[i]));
  }
  return text;
}

std::string_view stage_name(CommandStage stage) {
  switch (stage) {
    case CommandStage::kAccepted:
      return "accepted";
    case CommandStage::kRejected:
      return "rejected";
    case CommandStage::kCompleted:
      return "completed";
    case CommandStage::kFailed:
      return "failed";
  }
  return "unknown";
}

std::string ack_text(const CommandAck& ack, const CommandVocabulary& vocabulary) {
  std::string text = command_text(ack.command, vocabulary) + ": " + std::string(stage_name(ack.stage));
  const std::string reason = reason_text(ack, vocabulary);
  return reason.empty() ? text : text + ": " + reason;
}

}  // namespace omma
