#include "tests/bench/blink_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kSide = 768;

double uniform(std::mt19937_64& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}

}  // namespace

BlinkScene::BlinkScene(const BlinkCodes& codes, const BlinkProblemOptions& options, std::uint64_t seed)
    : codes_(codes), options_(options), random_(seed * 0x9e3779b97f4a7c15ULL + 3) {
  for (int i = 0; i < options.steady; ++i)
    steady_.emplace_back(uniform(random_, 0, kSide), uniform(random_, 0, kSide));
  place_ = {uniform(random_, 300, 468), uniform(random_, 300, 468)};
  const double course = uniform(random_, 0, 2 * std::numbers::pi);
  velocity_ = options.speed_px * Eigen::Vector2d(std::cos(course), std::sin(course));
  angle_ = uniform(random_, 0, 2 * std::numbers::pi);
  turn_ = uniform(random_, -0.01, 0.01);
  phase_ = static_cast<int>(random_() % static_cast<std::uint64_t>(codes.length));
}

BlinkFrame BlinkScene::next() {
  do {
    ++number_;
    place_ += velocity_;
    angle_ += turn_;
    phase_ = (phase_ + 1) % codes_.length;
  } while (uniform(random_, 0, 1) < options_.lost_frames);
  std::normal_distribution<double> gauss(0, options_.noise_px);
  std::vector<std::pair<Eigen::Vector2d, int>> seen;
  const auto see = [&](const Eigen::Vector2d& at, int light) {
    if (uniform(random_, 0, 1) < options_.missed) return;
    const double u = gauss(random_), v = gauss(random_);
    seen.emplace_back(at + Eigen::Vector2d(u, v), light);
  };
  const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(codes_.words.size()))));
  for (std::size_t k = 0; k < codes_.words.size(); ++k) {
    if (((codes_.words[k] >> phase_) & 1U) == 0) continue;
    const double x = (static_cast<int>(k) % side - 0.5 * (side - 1)) * options_.spacing_px;
    const double y = (static_cast<int>(k) / side - 0.5 * (side - 1)) * options_.spacing_px;
    see(place_ + Eigen::Vector2d(std::cos(angle_) * x - std::sin(angle_) * y,
                                 std::sin(angle_) * x + std::cos(angle_) * y),
        static_cast<int>(k));
  }
  for (const Eigen::Vector2d& star : steady_) see(star, -1);
  const int clutter = std::poisson_distribution<int>(options_.clutter)(random_);
  for (int i = 0; i < clutter; ++i)
    seen.emplace_back(Eigen::Vector2d(uniform(random_, 0, kSide), uniform(random_, 0, kSide)), -1);
  std::shuffle(seen.begin(), seen.end(), random_);
  BlinkFrame frame;
  frame.number = number_;
  for (const auto& [pixel, light] : seen) {
    frame.dots.push_back(pixel);
    frame.light.push_back(light);
  }
  return frame;
}

}  // namespace omma
