#include "components/extractor/classical/binary_objects.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// Holes by the Euler number of an 8-connected object from its 2×2 patches: objects − holes =
// (Q1 − Q3 − 2 Qdiagonal) / 4 (Gray 1971, IEEE Trans. Computers C-20, 551). Every pixel of a patch that holds
// one of the object is the object's; each patch is met once for each of them.
class PatchCount {
 public:
  explicit PatchCount(const GreyImage& binary) : binary_(binary) {}
  void add(int u, int v) {
    for (int dv = -1; dv <= 0; ++dv)
      for (int du = -1; du <= 0; ++du) add_patch(u + du, v + dv);
  }
  int holes() const { return 1 - (ones_ - threes_ / 3 - 2 * (diagonals_ / 2)) / 4; }

 private:
  int at(int u, int v) const {
    return u >= 0 && v >= 0 && u < binary_.width && v < binary_.height && binary_.at(u, v) != 0 ? 1 : 0;
  }
  void add_patch(int u, int v) {
    const int a = at(u, v), b = at(u + 1, v), c = at(u, v + 1), d = at(u + 1, v + 1);
    const int count = a + b + c + d;
    ones_ += count == 1 ? 1 : 0;
    threes_ += count == 3 ? 1 : 0;
    diagonals_ += count == 2 && a == d ? 1 : 0;
  }

  const GreyImage& binary_;
  int ones_ = 0, threes_ = 0, diagonals_ = 0;
};

}  // namespace

double BinaryObject::ellipticity() const noexcept {
  return area() / (4 * M_PI * std::sqrt(moments.determinant()));
}

Eigen::Vector2d axes_of(const Eigen::Matrix2d& moments) noexcept {
  const double mean = 0.5 * moments.trace();
  const double half = std::sqrt(std::max(0.0, mean * mean - moments.determinant()));
  return {std::sqrt(mean + half), std::sqrt(mean - half)};
}

ObjectFinder::ObjectFinder(int width, int height) {
  const std::size_t pixels = GreyImage(width, height).value.size();
  pixels_.reserve(pixels);
  seen_.resize(pixels);
}

// All pixels connected with the first.
void ObjectFinder::follow(const GreyImage& binary, std::uint32_t first) noexcept {
  const auto width = static_cast<std::uint32_t>(binary.width);
  pixels_.clear();
  pixels_.push_back(first);
  seen_[first] = pass_;
  for (std::size_t next = 0; next < pixels_.size(); ++next) {
    const int x = static_cast<int>(pixels_[next] % width);
    const int y = static_cast<int>(pixels_[next] / width);
    for (int v = std::max(0, y - 1); v <= std::min(binary.height - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(binary.width - 1, x + 1); ++u) {
        const auto i = static_cast<std::uint32_t>(v) * width + static_cast<std::uint32_t>(u);
        if (binary.value[i] == 0 || seen_[i] == pass_) continue;
        seen_[i] = pass_;
        pixels_.push_back(i);
      }
    }
  }
}

void ObjectFinder::measure(const GreyImage& binary) noexcept {
  const auto width = static_cast<std::uint32_t>(binary.width);
  const auto column = [&](std::uint32_t i) { return static_cast<int>(i % width); };
  const auto row = [&](std::uint32_t i) { return static_cast<int>(i / width); };
  const int u0 = column(pixels_.front()), v0 = row(pixels_.front());
  BinaryObject& object = object_;
  object.pixels = pixels_;
  object.left = object.right = u0;
  object.top = object.bottom = v0;
  double su = 0, sv = 0, uu = 0, uv = 0, vv = 0;  // about the first pixel: whole numbers
  PatchCount patches(binary);
  for (const std::uint32_t i : pixels_) {
    const int u = column(i), v = row(i);
    object.left = std::min(object.left, u);
    object.right = std::max(object.right, u);
    object.top = std::min(object.top, v);
    object.bottom = std::max(object.bottom, v);
    const double du = u - u0, dv = v - v0;
    su += du;
    sv += dv;
    uu += du * du;
    uv += du * dv;
    vv += dv * dv;
    patches.add(u, v);
  }
  const double n = object.area();
  const double mu = su / n, mv = sv / n;
  object.centre = {u0 + mu, v0 + mv};
  object.moments << uu / n - mu * mu, uv / n - mu * mv, uv / n - mu * mv, vv / n - mv * mv;
  object.moments += Eigen::Matrix2d::Identity() / 12;
  object.holes = patches.holes();
}

}  // namespace omma
