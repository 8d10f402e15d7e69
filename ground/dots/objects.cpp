#include "ground/dots/objects.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omma::ground {
namespace {

// Holes by the Euler number of an 8-connected object from its 2×2 patches: objects − holes =
// (Q1 − Q3 − 2 Qdiagonal) / 4 (Gray 1971, IEEE Trans. Computers C-20, 551).
int holes_of(const BinaryObject& object) {
  const int width = object.right - object.left + 3;
  const int height = object.bottom - object.top + 3;
  std::vector<int> in(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto at = [&](int u, int v) -> int& {
    return in[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  };
  for (const auto& [u, v] : object.pixels) at(u - object.left + 1, v - object.top + 1) = 1;
  int four_euler = 0;
  for (int v = 0; v + 1 < height; ++v) {
    for (int u = 0; u + 1 < width; ++u) {
      const int a = at(u, v), b = at(u + 1, v), c = at(u, v + 1), d = at(u + 1, v + 1);
      const int count = a + b + c + d;
      if (count == 1) four_euler += 1;
      if (count == 3) four_euler -= 1;
      if (count == 2 && a == d) four_euler -= 2;
    }
  }
  return 1 - four_euler / 4;
}

void measure(BinaryObject& object) {
  object.left = object.right = object.pixels.front().first;
  object.top = object.bottom = object.pixels.front().second;
  for (const auto& [u, v] : object.pixels) {
    object.left = std::min(object.left, u);
    object.right = std::max(object.right, u);
    object.top = std::min(object.top, v);
    object.bottom = std::max(object.bottom, v);
    object.centre += Eigen::Vector2d(u, v);
  }
  object.centre /= object.area();
  for (const auto& [u, v] : object.pixels) {
    const Eigen::Vector2d d = Eigen::Vector2d(u, v) - object.centre;
    object.moments += d * d.transpose();
  }
  object.moments /= object.area();
  object.moments += Eigen::Matrix2d::Identity() / 12;
  object.holes = holes_of(object);
}

}  // namespace

double BinaryObject::ellipticity() const {
  return area() / (4 * M_PI * std::sqrt(moments.determinant()));
}

double BinaryObject::elongation() const {
  const double mean = 0.5 * moments.trace();
  const double half = std::sqrt(std::max(0.0, mean * mean - moments.determinant()));
  return std::sqrt((mean + half) / (mean - half));
}

std::vector<BinaryObject> objects(const GreyImage& binary) {
  std::vector<BinaryObject> found;
  std::vector<bool> seen(binary.value.size(), false);
  const auto index = [&](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(binary.width) + static_cast<std::size_t>(u);
  };
  for (int v = 0; v < binary.height; ++v) {
    for (int u = 0; u < binary.width; ++u) {
      if (binary.at(u, v) == 0 || seen[index(u, v)]) continue;
      BinaryObject object;
      object.pixels.emplace_back(u, v);
      seen[index(u, v)] = true;
      for (std::size_t next = 0; next < object.pixels.size(); ++next) {
        const auto [x, y] = object.pixels[next];
        for (int b = std::max(0, y - 1); b <= std::min(binary.height - 1, y + 1); ++b) {
          for (int a = std::max(0, x - 1); a <= std::min(binary.width - 1, x + 1); ++a) {
            if (binary.at(a, b) == 0 || seen[index(a, b)]) continue;
            seen[index(a, b)] = true;
            object.pixels.emplace_back(a, b);
          }
        }
      }
      measure(object);
      found.push_back(std::move(object));
    }
  }
  return found;
}

void keep(GreyImage& binary, std::vector<BinaryObject>& found,
          const std::function<bool(const BinaryObject&)>& kept) {
  std::erase_if(found, [&](const BinaryObject& object) {
    if (kept(object)) return false;
    for (const auto& [u, v] : object.pixels) binary.at(u, v) = 0;
    return true;
  });
}

}  // namespace omma::ground
