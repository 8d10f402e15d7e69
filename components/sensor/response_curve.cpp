#include "components/sensor/response_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {

ResponseCurve::ResponseCurve(std::vector<ResponsePoint> points) : points_(std::move(points)) {
  if (points_.size() < 2) throw std::invalid_argument("a response curve has at least two points");
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (!(points_[i].grey > points_[i - 1].grey && points_[i].light > points_[i - 1].light))
      throw std::invalid_argument("a response curve rises in both columns");
  }
}

double ResponseCurve::slope(double grey) const noexcept {
  auto right = std::upper_bound(points_.begin() + 1, points_.end() - 1, grey,
                                [](double x, const ResponsePoint& p) { return x < p.grey; });
  const ResponsePoint& b = *right;
  const ResponsePoint& a = *(right - 1);
  return (b.light - a.light) / (b.grey - a.grey);
}

double ResponseCurve::light(double grey) const noexcept {
  auto right = std::upper_bound(points_.begin() + 1, points_.end() - 1, grey,
                                [](double x, const ResponsePoint& p) { return x < p.grey; });
  return right->light + slope(grey) * (grey - right->grey);
}

void ResponseCurve::even_levels(std::uint16_t white, double black,
                                std::span<std::uint16_t> even) const noexcept {
  const double scale = 1 / slope(black);
  const double offset = light(black);
  const std::size_t below = std::min<std::size_t>(white, even.size());
  for (std::size_t grey = 0; grey < below; ++grey) {
    const double level = black + scale * (light(static_cast<double>(grey)) - offset);
    even[grey] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 65535.0)));
  }
  std::fill(even.begin() + static_cast<std::ptrdiff_t>(below), even.end(), std::uint16_t{65535});
}

double ResponseCurve::relative_noise(double noise, double black) const {
  const double scale = 1 / slope(black);
  const double offset = light(black);
  // Variance at light L is (noise · scale · slope)²; ρ² is the mean of what it has over noise², as a share of
  // L², over the octaves in which the slope has doubled at least. Below them read noise and photons are
  // larger.
  double sum = 0;
  int count = 0;
  const double top = scale * (points_.back().light - offset);
  for (double level = 4 * noise; level < top; level *= 2) {
    // The grey level that gives this light.
    double low = black, high = points_.back().grey;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (scale * (light(middle) - offset) < level ? low : high) = middle;
    }
    const double there = noise * scale * slope(0.5 * (low + high));
    if (there < 2 * noise) continue;
    sum += std::max(0.0, there * there - noise * noise) / (level * level);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

ResponseCurve read_response_curve(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  std::vector<ResponsePoint> points;
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    const std::vector<std::string_view> words = words_of(line.substr(0, line.find('#')));
    if (words.empty()) continue;
    const auto grey = finite_number(words[0]);
    const auto light = words.size() == 2 ? finite_number(words[1]) : std::nullopt;
    if (!grey || !light)
      throw InputError(file.string(), number, "response", "two numbers, grey level and light", excerpt(line));
    if (!points.empty() && !(*grey > points.back().grey && *light > points.back().light))
      throw InputError(file.string(), number, "response", "both columns rising", excerpt(line));
    points.push_back({*grey, *light});
  }
  if (points.size() < 2)
    throw InputError(file.string(), 0, "response", "at least two points", std::to_string(points.size()));
  return ResponseCurve(std::move(points));
}

}  // namespace omma
