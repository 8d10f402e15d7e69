// The dictionary as JSON.
#include "fsw/services/dictionary.hpp"

#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/wiring.hpp"
#include "fsw/services/dictionary_parts.hpp"
#include "fsw/services/event_text.hpp"
#include "fsw/services/json_text.hpp"

namespace omma {
namespace {

void write_event(JsonText& json, const EventDescriptor& event) {
  json.open_object().key("id").number(event.id).key("name").string(event.name);
  json.key("severity").string(severity_name(event.severity)).key("text").string(event.text);
  json.key("values").open_array();
  for (std::size_t i = 0; i < event.value_count(); ++i) {
    const EventValue& value = event.values[i];
    json.open_object().key("name").string(value.name).key("unit").string(value.unit);
    if (!value.choices.empty()) write_choices(json, value.choices);
    json.close_object();
  }
  json.close_array().key("burst").number(event.burst);
  json.key("interval_s").number(static_cast<double>(event.interval_ns) / 1e9).close_object();
}

void write_topic(JsonText& json, const TopicDescriptor& topic) {
  json.open_object().key("name").string(topic.name).key("type").string(topic.type);
  json.key("reliable").boolean(topic.reliable).key("depth").number(topic.depth);
  json.key("deadline_s").number(topic.deadline_s).key("measured").boolean(topic.measured).close_object();
}

void write_rule(JsonText& json, const BudgetRule& rule) {
  json.open_object().key("reaction").string(reaction_name(rule.reaction));
  if (rule.reaction != BreachReaction::kNone)
    json.key("breaches").number(rule.breaches).key("in_steps").number(rule.window());
  json.close_object();
}

void write_group(JsonText& json, const RateGroup& group, std::chrono::nanoseconds base_period) {
  json.open_object().key("name").string(group.name);
  json.key("period_s").number(static_cast<double>(base_period.count()) * group.divisor / 1e9);
  json.key("offset_s").number(static_cast<double>(base_period.count()) * group.offset / 1e9);
  json.key("priority").number(group.priority);
  if (group.core != kAnyCore) json.key("core").number(group.core);
  json.key("critical").boolean(group.critical);
  json.key("components").open_array();
  for (const ScheduledComponent& scheduled : group.components) {
    json.open_object().key("name").string(scheduled.component.name());
    json.key("budget_s").number(static_cast<double>(scheduled.budget.count()) / 1e9);
    json.key("threads").number(scheduled.threads).key("on_breach");
    write_rule(json, scheduled.on_breach);
    if (scheduled.phases != kAnyMode) write_modes(json, "modes", scheduled.phases);
    json.close_object();
  }
  json.close_array().close_object();
}

void write_connection(JsonText& json, const Wiring& wiring, const Connection& connection) {
  json.open_object().key("from").string(wiring.output_name(connection.output));
  json.key("to").string(wiring.input_name(connection.input));
  json.key("by").string(connection.crossing != nullptr ? connection.crossing->kind() : "reference");
  json.key("previous_tick")
      .boolean(wiring.inputs[connection.input].port->reads_previous_tick())
      .close_object();
}

}  // namespace

std::string dictionary_json(const Dictionary& dictionary, const RateGroupTable& table) {
  JsonText json;
  json.open_object().key("program").string(dictionary.program);
  json.key("events").open_array();
  for (const EventDescriptor& event : dictionary.events) write_event(json, event);
  json.close_array();
  write_operations(json, dictionary);
  json.key("topics").open_array();
  for (const TopicDescriptor& topic : dictionary.topics) write_topic(json, topic);
  json.close_array().key("rate_groups").open_array();
  for (const RateGroup& group : table.groups) write_group(json, group, table.base_period);
  json.close_array().key("connections").open_array();
  const Wiring wiring = trace_wiring(table);
  for (const Connection& connection : wiring.connections) write_connection(json, wiring, connection);
  json.close_array().key("idl").string(dictionary.idl).close_object();
  return json.text();
}

}  // namespace omma
