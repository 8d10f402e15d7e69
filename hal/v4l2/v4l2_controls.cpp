#include "hal/v4l2/v4l2_controls.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>

#include "fsw/kernel/input_error.hpp"

namespace omma::v4l2 {
namespace {

struct Setting {
  const Control* control = nullptr;
  std::int64_t value = 0;
  std::string field;
};

std::string names_of(const std::vector<Control>& controls) {
  std::string names;
  for (const Control& control : controls) names += (names.empty() ? "" : ", ") + control.name;
  return names.empty() ? "a device with controls" : "one of " + names;
}

const Control& find_control(const std::vector<Control>& controls, const CameraSetup& setup,
                            const std::string& name) {
  std::vector<std::string_view> candidates = usual_names(name);
  for (const CameraControl& mapped : setup.control_names)
    if (mapped.name == name) candidates = {mapped.value};
  for (const std::string_view candidate : candidates)
    for (const Control& control : controls)
      if (control.name == candidate) return control;
  throw InputError(setup.where, 0, "controls." + name, names_of(controls), std::string(candidates.front()));
}

std::string range_text(const Control& control) {
  std::string text = std::to_string(control.least) + " to " + std::to_string(control.most);
  if (control.step > 1) text += " in steps of " + std::to_string(control.step);
  for (std::size_t i = 0; i < control.items.size(); ++i)
    text += (i == 0 ? " or one of " : ", ") + control.items[i].second;
  return text;
}

std::optional<std::int64_t> value_of(const Control& control, const std::string& text) {
  for (const auto& [index, item] : control.items)
    if (item == text) return index;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (control.type == V4L2_CTRL_TYPE_BUTTON) return value;
  if (value < control.least || value > control.most) return std::nullopt;
  if (control.step > 1 && static_cast<std::uint64_t>(value - control.least) % control.step != 0)
    return std::nullopt;
  return value;
}

bool decides_others(const Control& control) {
  return control.type == V4L2_CTRL_TYPE_MENU || control.type == V4L2_CTRL_TYPE_BOOLEAN;
}

void set(const Device& device, const CameraSetup& setup, const Setting& setting) {
  const std::string wanted = setting.control->name + " = " + std::to_string(setting.value);
  if (const int error = set_control(device, *setting.control, setting.value); error != 0)
    throw InputError(setup.where, 0, setting.field, "a device that takes " + wanted, std::strerror(error));
  if (setting.control->type == V4L2_CTRL_TYPE_BUTTON) return;
  for (const Control& now : controls_of(device)) {
    if (now.id != setting.control->id || now.value == setting.value) continue;
    throw InputError(setup.where, 0, setting.field, "a device that keeps " + wanted,
                     std::to_string(now.value));
  }
}

}  // namespace

std::vector<std::string_view> usual_names(std::string_view name) {
  if (name == "exposure") return {"exposure_time_absolute", "exposure_absolute", "exposure"};
  if (name == "gain") return {"analogue_gain", "gain"};
  if (name == "blacklevel") return {"black_level", "blacklevel"};
  if (name == "trigger") return {"trigger_mode", "trigger"};
  return {name};
}

void apply_controls(const Device& device, const CameraSetup& setup) {
  if (setup.controls.empty()) return;
  const std::vector<Control> controls = controls_of(device);
  std::vector<Setting> settings;  // all are checked before the first is set
  for (const CameraControl& asked : setup.controls) {
    const Control& control = find_control(controls, setup, asked.name);
    const std::string field = "controls." + asked.name;
    if (control.read_only)
      throw InputError(setup.where, 0, field, "a control that can be set",
                       control.name + ", which is read-only");
    const auto value = value_of(control, asked.value);
    if (!value) throw InputError(setup.where, 0, field, range_text(control), asked.value);
    settings.push_back({&control, *value, field});
  }
  std::stable_partition(settings.begin(), settings.end(),
                        [](const Setting& setting) { return decides_others(*setting.control); });
  for (const Setting& setting : settings) set(device, setup, setting);
}

}  // namespace omma::v4l2
