#include "components/imaging/exposure_match.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace omma {

std::array<double, limits::kCameras> match_exposure(const OverlapSums& sums, int cameras,
                                                    const ExposureMatchSettings& settings) noexcept {
  using Normal = Eigen::Matrix<double, limits::kCameras, limits::kCameras>;
  using Right = Eigen::Matrix<double, limits::kCameras, 1>;
  // e = ½ Σ_ab N_ab ((g_a Ī_ab − g_b Ī_ba)²/σ_N² + (1 − g_a)²/σ_g²), quadratic in the gains. A camera without
  // overlap keeps its gain of 1 through the small prior on the diagonal.
  Normal normal = Normal::Identity();
  Right right = Right::Ones();
  const double level_weight = 1 / (settings.level_sigma * settings.level_sigma);
  const double gain_weight = 1 / (settings.gain_sigma * settings.gain_sigma);
  for (int a = 0; a < cameras; ++a) {
    for (int b = a + 1; b < cameras; ++b) {
      const OverlapSums::Pair& pair = sums.pairs[a][b];
      if (pair.count == 0) continue;
      const double n = pair.count;
      const double mean_a = pair.first / n;
      const double mean_b = pair.second / n;
      normal(a, a) += n * (level_weight * mean_a * mean_a + gain_weight);
      normal(b, b) += n * (level_weight * mean_b * mean_b + gain_weight);
      normal(a, b) -= n * level_weight * mean_a * mean_b;
      normal(b, a) -= n * level_weight * mean_a * mean_b;
      right(a) += n * gain_weight;
      right(b) += n * gain_weight;
    }
  }
  const Right gains = normal.llt().solve(right);
  std::array<double, limits::kCameras> out{};
  for (int i = 0; i < limits::kCameras; ++i) out[i] = gains(i);
  return out;
}

}  // namespace omma
