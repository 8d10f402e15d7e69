#include "components/imaging/grey_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omma {

std::uint16_t GreyScale::level(double light) const noexcept {
  if (std::isnan(light)) return 0;
  const auto rounded = [](double x) { return static_cast<std::uint16_t>(std::lround(x)); };
  if (scale == ImageScale::kLinear) return rounded(largest() * std::clamp(light / most, 0.0, 1.0));
  double x = 0;
  if (scale == ImageScale::kSquareRoot) {
    x = std::sqrt(std::clamp((light + soft) / (most + soft), 0.0, 1.0));
  } else {
    const double least = std::asinh(-1.0);
    x = std::clamp((std::asinh(light / soft) - least) / (std::asinh(most / soft) - least), 0.0, 1.0);
  }
  return rounded(1 + (largest() - 1) * x);
}

double GreyScale::light(int level) const noexcept {
  if (scale == ImageScale::kLinear) return most * level / largest();
  if (level <= 0) return std::numeric_limits<double>::quiet_NaN();
  const double x = (level - 1.0) / (largest() - 1);
  if (scale == ImageScale::kSquareRoot) return (most + soft) * x * x - soft;
  const double least = std::asinh(-1.0);
  return soft * std::sinh(least + x * (std::asinh(most / soft) - least));
}

}  // namespace omma
