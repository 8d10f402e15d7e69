// Response curve of a sensor whose grey levels do not rise evenly with light (logarithmic, piecewise linear):
// levels from even ones by a table, and how much worse the noise of a bright pixel becomes by it. Formulas in
// docs/algorithms/sensor.md#response.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace omma {

struct ResponsePoint {
  double grey = 0;   ///< level that the sensor gives
  double light = 0;  ///< that makes it, any unit
};

class ResponseCurve {
 public:
  ResponseCurve() = default;  ///< of an even sensor
  /// Straight between the points; at least two, both columns strictly rising (std::invalid_argument).
  explicit ResponseCurve(std::vector<ResponsePoint> points);

  bool empty() const { return points_.empty(); }
  const std::vector<ResponsePoint>& points() const { return points_; }
  double light(double grey) const noexcept;  ///< extended beyond the ends [the curve's unit]
  /// Table from grey levels to even ones of 16 bits: the darkest points keep their slope of one level a
  /// level, so that noise in the dark is as it was; `white` and above, and what is over 65535, is full.
  /// @param black  level of no light: where the slope is kept
  void even_levels(std::uint16_t white, double black, std::span<std::uint16_t> even) const noexcept;
  /// How a pixel's noise of `noise` raw grey levels shows on the even scale: √(σ² + (ρ L)²) with L the light
  /// over black in even levels; ρ in the mean over the octaves of light in which it counts.
  double relative_noise(double noise, double black) const;

 private:
  double slope(double grey) const noexcept;
  std::vector<ResponsePoint> points_;
};

/// Two columns, grey level and light, tab or space between them, # begins a comment.
/// @throws InputError: missing, no number, a column that does not rise, fewer than two points
ResponseCurve read_response_curve(const std::filesystem::path& file);

}  // namespace omma
