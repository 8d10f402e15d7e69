#include "hal/libcamera/libcamera_names.hpp"

#include <libcamera/formats.h>

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

namespace formats = libcamera::formats;

struct NamedFormat {
  std::string_view name;
  libcamera::PixelFormat format;
};

const std::array kFormats{NamedFormat{"GREY", formats::R8},      NamedFormat{"Y10", formats::R10},
                          NamedFormat{"Y12", formats::R12},      NamedFormat{"BA81", formats::SBGGR8},
                          NamedFormat{"GBRG", formats::SGBRG8},  NamedFormat{"GRBG", formats::SGRBG8},
                          NamedFormat{"RGGB", formats::SRGGB8},  NamedFormat{"BG10", formats::SBGGR10},
                          NamedFormat{"GB10", formats::SGBRG10}, NamedFormat{"BA10", formats::SGRBG10},
                          NamedFormat{"RG10", formats::SRGGB10}, NamedFormat{"BG12", formats::SBGGR12},
                          NamedFormat{"GB12", formats::SGBRG12}, NamedFormat{"BA12", formats::SGRBG12},
                          NamedFormat{"RG12", formats::SRGGB12}, NamedFormat{"BYR2", formats::SBGGR16},
                          NamedFormat{"GB16", formats::SGBRG16}, NamedFormat{"GR16", formats::SGRBG16},
                          NamedFormat{"RG16", formats::SRGGB16}, NamedFormat{"YUYV", formats::YUYV},
                          NamedFormat{"UYVY", formats::UYVY},    NamedFormat{"RGB3", formats::BGR888},
                          NamedFormat{"BGR3", formats::RGB888}};

template <class Number>
std::optional<libcamera::ControlValue> number_value(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return libcamera::ControlValue(value);
}

std::optional<libcamera::ControlValue> value_of(const libcamera::ControlId& control,
                                                const std::string& text) {
  switch (control.type()) {
    case libcamera::ControlTypeBool:
      return libcamera::ControlValue(text != "0");
    case libcamera::ControlTypeInteger32:
      return number_value<std::int32_t>(text);
    case libcamera::ControlTypeInteger64:
      return number_value<std::int64_t>(text);
    case libcamera::ControlTypeFloat:
      return number_value<float>(text);
    default:
      return std::nullopt;
  }
}

template <class Number>
bool lies_in(const libcamera::ControlInfo& range, const libcamera::ControlValue& value) {
  const auto number = value.get<Number>();
  return number >= range.min().get<Number>() && number <= range.max().get<Number>();
}

bool is_in_range(const libcamera::ControlInfo& range, const libcamera::ControlValue& value) {
  if (range.min().type() != value.type() || range.max().type() != value.type()) return true;  // none is told
  switch (value.type()) {
    case libcamera::ControlTypeInteger32:
      return lies_in<std::int32_t>(range, value);
    case libcamera::ControlTypeInteger64:
      return lies_in<std::int64_t>(range, value);
    case libcamera::ControlTypeFloat:
      return lies_in<float>(range, value);
    default:
      return true;
  }
}

std::string device_name(const CameraSetup& setup, const std::string& name) {
  for (const CameraControl& mapped : setup.control_names)
    if (mapped.name == name) return mapped.value;
  if (name == "exposure") return "ExposureTime";
  if (name == "gain") return "AnalogueGain";
  if (name == "gamma") return "Gamma";
  return name;
}

}  // namespace

libcamera::PixelFormat libcamera_format(const PixelLayout& layout) {
  for (const auto& [name, format] : kFormats)
    if (name == layout.name) return format;
  return {};
}

std::string format_name(const libcamera::PixelFormat& format) {
  for (const auto& [name, known] : kFormats)
    if (known == format) return std::string(name);
  return format.toString();
}

bool is_raw(const PixelLayout& layout) {
  return layout.kind == PixelKind::kBayer || layout.kind == PixelKind::kGrey;
}

void read_libcamera_controls(const CameraSetup& setup, const libcamera::ControlInfoMap& known,
                             libcamera::ControlList& controls) {
  for (const CameraControl& asked : setup.controls) {
    const std::string field = "controls." + asked.name;
    const std::string name = device_name(setup, asked.name);
    std::string names;
    bool found = false;
    for (const auto& [id, range] : known) {
      names += (names.empty() ? "" : ", ") + id->name();
      if (id->name() != name) continue;
      found = true;
      const auto value = value_of(*id, asked.value);
      if (!value || !is_in_range(range, *value))
        throw InputError(setup.where, 0, field, range.toString(), asked.value);
      controls.set(id->id(), *value);
    }
    if (!found)
      throw InputError(setup.where, 0, field, names.empty() ? "a camera with controls" : "one of " + names,
                       name);
  }
}

}  // namespace omma
