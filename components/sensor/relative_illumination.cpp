#include "components/sensor/relative_illumination.hpp"

#include <algorithm>
#include <cmath>

namespace omma {

RelativeIllumination::RelativeIllumination(const Lens& lens, std::span<const double> shares)
    : columns_(lens.width() / kCell + 2), rows_(lens.height() / kCell + 2) {
  if (shares.empty()) return;
  const auto last = static_cast<double>(shares.size() - 1);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Eigen::Vector3d ray;
      double place = last;  // beyond the lens: as at its edge
      if (lens.bearing(Eigen::Vector2d(column * kCell, row * kCell), ray)) {
        const double angle = std::acos(std::clamp(ray.z(), -1.0, 1.0));
        place = std::min(last, last * angle / lens.max_angle());
      }
      const auto i = static_cast<std::size_t>(place);
      const double next = shares[std::min(i + 1, shares.size() - 1)];
      share_.push_back(static_cast<float>(shares[i] + (place - static_cast<double>(i)) * (next - shares[i])));
    }
  }
}

float RelativeIllumination::at(const Eigen::Vector2d& pixel) const noexcept {
  if (share_.empty()) return 1;
  const double x = std::clamp(pixel.x() / kCell, 0.0, columns_ - 1.001);
  const double y = std::clamp(pixel.y() / kCell, 0.0, rows_ - 1.001);
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const auto fx = static_cast<float>(x - column);
  const auto fy = static_cast<float>(y - row);
  const auto share = [&](int r, int c) {
    return share_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(c)];
  };
  const float top = share(row, column) + fx * (share(row, column + 1) - share(row, column));
  const float bottom = share(row + 1, column) + fx * (share(row + 1, column + 1) - share(row + 1, column));
  return top + fy * (bottom - top);
}

}  // namespace omma
