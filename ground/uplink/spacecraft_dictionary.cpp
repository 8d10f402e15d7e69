// JSON to descriptors.
#include "ground/uplink/spacecraft_dictionary.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"

namespace omma::ground {

using nlohmann::json;

struct SpacecraftDictionary::Reader {
  SpacecraftDictionary& to;

  std::string_view keep(const json& text) { return to.words_.emplace_back(text.get<std::string>()); }

  ValueDescriptor value(const json& from) {
    static const std::map<std::string, ValueType> kTypes{{"number", ValueType::kNumber},
                                                         {"integer", ValueType::kInteger},
                                                         {"flag", ValueType::kFlag},
                                                         {"choice", ValueType::kChoice},
                                                         {"parameter", ValueType::kParameter}};
    ValueDescriptor value{.name = keep(from.at("name")),
                          .unit = keep(from.at("unit")),
                          .type = kTypes.at(from.at("type").get<std::string>())};
    value.least = from.value("least", 0.0);
    value.most = from.value("most", 0.0);
    value.choices = choices(from);
    return value;
  }

  std::string_view choices(const json& from) {
    std::string joined;
    for (const json& choice : from.value("choices", json::array()))
      joined += (joined.empty() ? "" : "|") + choice.get<std::string>();
    return to.words_.emplace_back(joined);
  }

  EventDescriptor event(const json& from) {
    EventDescriptor event{.id = from.at("id").get<std::uint16_t>(),
                          .name = keep(from.at("name")),
                          .text = keep(from.at("text"))};
    const json& values = from.at("values");
    for (std::size_t i = 0; i < values.size(); ++i)
      event.values.at(i) = {keep(values[i].at("name")), keep(values[i].at("unit")), choices(values[i])};
    if (!is_well_formed(event))
      throw std::runtime_error("event " + std::string(event.name) + " has no such values");
    return event;
  }

  CommandDescriptor command(const json& from) {
    CommandDescriptor command{.id = from.at("opcode").get<std::uint16_t>(),
                              .name = keep(from.at("name")),
                              .text = keep(from.at("text"))};
    const json& arguments = from.at("arguments");
    for (std::size_t i = 0; i < arguments.size(); ++i) command.arguments.at(i) = value(arguments[i]);
    return command;
  }
};

SpacecraftDictionary::SpacecraftDictionary(std::string_view text, const std::string& from) {
  Reader reader{*this};
  try {
    const json dictionary = json::parse(text);
    for (const json& command : dictionary.at("commands")) commands_.push_back(reader.command(command));
    for (const json& event : dictionary.value("events", json::array()))
      events_.push_back(reader.event(event));
    for (const json& entry : dictionary.value("parameters", json::array())) {
      parameters_.push_back(
          {entry.at("id").get<std::uint16_t>(), entry.at("name").get<std::string>(), reader.value(entry)});
      parameter_notes_.push_back(format("%-10.9g %s", entry.at("initial").get<double>(),
                                        entry.at("text").get<std::string>().c_str()));
    }
  } catch (const std::exception& error) {
    throw InputError(from, 0, "dictionary", "what `omma-fsw MISSION --dictionary` prints", error.what());
  }
}

std::string SpacecraftDictionary::text() const {
  std::string text;
  for (const CommandDescriptor& command : commands_) {
    std::string words(command.name);
    for (std::size_t i = 0; i < command.argument_count(); ++i)
      words.append(" <").append(command.arguments[i].name).append(">");
    text += format("%-44s %s\n", words.c_str(), std::string(command.text).c_str());
    for (std::size_t i = 0; i < command.argument_count(); ++i)
      if (command.arguments[i].type != ValueType::kParameter)
        text += format("    %-40s %s\n", std::string(command.arguments[i].name).c_str(),
                       allowed_text(command.arguments[i]).c_str());
  }
  if (!parameters_.empty()) text += "\nparameters, with their values at the start\n";
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    text += format("    %-36s %s (%s)\n", parameters_[i].name.c_str(), parameter_notes_[i].c_str(),
                   allowed_text(parameters_[i].value).c_str());
  return text;
}

}  // namespace omma::ground
