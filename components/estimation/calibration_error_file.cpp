#include "components/estimation/calibration_error_file.hpp"

#include <numbers>

namespace omma {

CalibrationError read_calibration_error(const TomlTable& table) {
  constexpr double kDegree = std::numbers::pi / 180;
  CalibrationError error;
  error.camera_rotation = kDegree * table.number("camera_rotation_deg", {0, 10}, 0);
  error.camera_position = table.number("camera_position_m", {0, 1}, 0);
  error.lens_scale = table.number("lens_scale", {0, 0.1}, 0);
  error.lens_bend = table.number("lens_bend", {0, 0.1}, 0);
  error.survey = table.number("survey_m", {0, 1}, 0);
  error.survey_scale = table.number("survey_scale", {0, 0.1}, 0);
  table.refuse_unknown_keys();
  return error;
}

IntegrityOptions read_integrity(const TomlTable& table) {
  IntegrityOptions options;
  options.risk = table.number("risk", {1e-12, 0.5}, options.risk);
  options.dot_fault = table.number("dot_fault", {0, 1}, options.dot_fault);
  options.camera_fault = table.number("camera_fault", {0, 1}, options.camera_fault);
  options.false_alarm = table.number("false_alarm", {1e-15, 0.5}, options.false_alarm);
  table.refuse_unknown_keys();
  return options;
}

}  // namespace omma
