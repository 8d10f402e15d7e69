#include "components/tracker/dot_patches.hpp"

#include <algorithm>
#include <cmath>

#include "components/geometry/pose.hpp"

namespace omma {
namespace {

constexpr std::size_t kSeedsPerBlock = 8;
constexpr std::size_t kNearest = 7;            // neighbours of a seed that form its foursomes
constexpr double kLeastHeightInSigmas = 10.0;  // of the spanning triangle, over a dot's noise

struct Choice {
  std::uint8_t a, b, c;
};

/// The 35 ways to choose three of seven neighbours, those of small rank first.
constexpr std::array<Choice, 35> choices() {
  std::array<Choice, 35> all{};
  std::size_t n = 0;
  for (int sum = 6; sum <= 18; ++sum)
    for (std::uint8_t a = 1; a <= kNearest; ++a)
      for (std::uint8_t b = static_cast<std::uint8_t>(a + 1); b <= kNearest; ++b)
        for (std::uint8_t c = static_cast<std::uint8_t>(b + 1); c <= kNearest; ++c)
          if (a + b + c == sum) all[n++] = {a, b, c};
  return all;
}
constexpr std::array<Choice, 35> kChoices = choices();

double doubled_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

}  // namespace

bool DotPatches::start(std::span<const RigDot> dots, double gate) noexcept {
  dots_ = dots.first(std::min<std::size_t>(dots.size(), std::size_t{1} << 16));
  gate_ = gate;
  seeds_.clear();
  order_.clear();
  rewind();
  for (std::size_t first = 0; first < dots_.size();) {
    std::size_t last = first + 1;
    while (last < dots_.size() && dots_[last].camera == dots_[first].camera) ++last;
    add_camera(first, std::min(last, first + kDotsPerCamera));
    first = last;
  }
  for (std::size_t seed = 0; seed < seeds_.size(); ++seed) order_.push_back(static_cast<std::uint16_t>(seed));
  std::sort(order_.begin(), order_.end(), [this](std::uint16_t a, std::uint16_t b) {
    return seeds_[a].crowding < seeds_[b].crowding || (seeds_[a].crowding == seeds_[b].crowding && a < b);
  });
  return !seeds_.empty();
}

void DotPatches::rewind() noexcept {
  visited_.fill(0);
  diagonal_ = block_ = in_block_ = 0;
}

void DotPatches::add_camera(std::size_t first, std::size_t last) noexcept {
  if (last - first < 4) return;
  for (std::size_t i = first; i < last; ++i) {
    float nearest[3] = {8, 8, 8};
    for (std::size_t j = first; j < last; ++j) {
      if (j == i) continue;
      auto distance = static_cast<float>((dots_[i].ray - dots_[j].ray).squaredNorm());
      for (float& kept : nearest)
        if (distance < kept) std::swap(distance, kept);
    }
    Seed seed;
    seed.dot = static_cast<std::uint16_t>(i);
    seed.first = static_cast<std::uint16_t>(first);
    seed.last = static_cast<std::uint16_t>(last);
    seed.crowding = nearest[2];
    seeds_.push_back(seed);
  }
}

std::span<const std::uint16_t> DotPatches::around(std::size_t index) noexcept {
  Seed& seed = seeds_[index];
  if (seed.neighbours_known == 0) {
    std::array<std::pair<float, std::uint16_t>, kDotsPerCamera> near;
    std::size_t count = 0;
    for (std::uint16_t j = seed.first; j < seed.last; ++j)
      near[count++] = {static_cast<float>((dots_[j].ray - dots_[seed.dot].ray).squaredNorm()), j};
    const std::size_t kept = std::min(count, kNeighbours + 1);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept),
                      near.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < kept; ++k) seed.neighbours[k] = near[k].second;
    seed.neighbours_known = static_cast<std::uint16_t>(kept);
  }
  return {seed.neighbours.data(), seed.neighbours_known};
}

bool DotPatches::next(DotFoursome& foursome, bool seed_first) noexcept {
  const std::size_t blocks = (order_.size() + kSeedsPerBlock - 1) / kSeedsPerBlock;
  for (; diagonal_ < blocks + kChoices.size(); ++diagonal_, block_ = 0) {
    for (; block_ <= diagonal_ && block_ < blocks; ++block_, in_block_ = 0) {
      const std::size_t rank = diagonal_ - block_;
      if (rank >= kChoices.size()) continue;
      while (in_block_ < kSeedsPerBlock) {
        const std::size_t at = block_ * kSeedsPerBlock + in_block_++;
        if (at >= order_.size()) break;
        foursome.seed = order_[at];
        const std::span<const std::uint16_t> near = around(foursome.seed);
        const Choice& choice = kChoices[rank];
        if (choice.c >= near.size()) continue;
        foursome.dots = {near[0], near[choice.a], near[choice.b], near[choice.c]};
        if (!visited(foursome.dots) && form(foursome, seed_first)) return true;
      }
    }
  }
  return false;
}

bool DotPatches::visited(std::array<std::uint16_t, 4> dots) noexcept {
  std::sort(dots.begin(), dots.end());
  std::uint64_t key = 0;
  for (const std::uint16_t dot : dots) key = key << 16 | dot;
  // A crowded table forgets: the foursome is then looked at again, which costs time and nothing else.
  std::uint64_t& slot = visited_[(key * 0x9e3779b97f4a7c15ULL >> 40) % kVisitedSlots];
  if (slot == key) return true;
  slot = key;
  return false;
}

bool DotPatches::form(DotFoursome& foursome, bool seed_first) const noexcept {
  std::array<std::uint16_t, 4>& dots = foursome.dots;
  foursome.middle.setZero();
  for (const std::uint16_t dot : dots) foursome.middle += dots_[dot].ray;
  foursome.middle.normalize();
  const Eigen::Matrix<double, 3, 2> plane = tangent_basis(foursome.middle);
  std::array<Eigen::Vector2d, 4> at;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& ray = dots_[dots[i]].ray;
    const double depth = ray.dot(foursome.middle);
    if (!(depth > 0.1)) return false;
    at[i] = plane.transpose() * ray / depth;
  }
  // The largest triangle spans; the dot outside it goes last.
  std::size_t left_out = 0;
  double largest = -1;
  for (std::size_t i = seed_first ? 1 : 0; i < 4; ++i) {
    const double area = std::abs(doubled_area(at[(i + 1) % 4], at[(i + 2) % 4], at[(i + 3) % 4]));
    if (area > largest) {
      largest = area;
      left_out = i;
    }
  }
  std::swap(at[left_out], at[3]);
  std::swap(dots[left_out], dots[3]);

  DotPatch& patch = foursome.patch;
  patch.at = at;
  patch.u = at[1] - at[0];
  patch.v = at[2] - at[0];
  const double sigma = dots_[dots[3]].sigma;
  const double longest = std::max({patch.u.norm(), patch.v.norm(), (patch.u - patch.v).norm()});
  if (!(largest > kLeastHeightInSigmas * sigma * longest)) return false;
  const Eigen::Vector2d d = at[3] - at[0];
  const double area = patch.u.x() * patch.v.y() - patch.u.y() * patch.v.x();
  patch.alpha = (d.x() * patch.v.y() - d.y() * patch.v.x()) / area;
  patch.beta = (patch.u.x() * d.y() - patch.u.y() * d.x()) / area;
  const double rest = 1 - patch.alpha - patch.beta;
  foursome.spread = std::sqrt(1 + patch.alpha * patch.alpha + patch.beta * patch.beta + rest * rest);
  patch.noise = gate_ * sigma * foursome.spread;
  patch.alpha_noise = patch.noise / std::abs(area) * patch.v.norm();
  patch.beta_noise = patch.noise / std::abs(area) * patch.u.norm();
  return true;
}

}  // namespace omma
