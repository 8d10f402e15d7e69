#include "sim/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace omma::sim {

double Sensor::saturation() const {
  if (logarithmic) {
    const LogPixel pixel = log_pixel();
    return std::min(pixel.most(), pixel.electrons(white_level()));
  }
  return std::min(full_well, (white_level() - black_level) * gain);
}

double Sensor::variance(double mean) const {
  if (!logarithmic) return mean + read_noise * read_noise + gain * gain / 12.0;
  const LogPixel pixel = log_pixel();
  const double noise = pixel.noise(mean);
  const double slope = pixel.slope(mean);
  return (noise * noise + 1.0 / 12.0) / (slope * slope);
}

namespace {

// Fills pixels from `v` on in steps of `step` until the charge is used up or the column ends.
void spill(float charge, int v, int step, int width, int height, float full_well, float* column) {
  for (; charge > 0 && v >= 0 && v < height; v += step) {
    float& pixel = column[static_cast<std::ptrdiff_t>(v) * width];
    if (pixel >= full_well) continue;
    const float taken = std::min(charge, full_well - pixel);
    pixel += taken;
    charge -= taken;
  }
}

}  // namespace

void bloom(const Sensor& sensor, int width, int height, std::span<float> electrons) {
  if (sensor.logarithmic) return;  // its pixels do not collect charge
  const auto full_well = static_cast<float>(sensor.full_well);
  const auto share = static_cast<float>(sensor.blooming);
  std::vector<char> over(static_cast<std::size_t>(width), 0);  // columns with something to spill
  for (int v = 0; v < height; ++v) {
    const float* row = electrons.data() + static_cast<std::ptrdiff_t>(v) * width;
    for (int u = 0; u < width; ++u) over[static_cast<std::size_t>(u)] |= row[u] > full_well ? 1 : 0;
  }
  for (int u = 0; u < width; ++u) {
    if (over[static_cast<std::size_t>(u)] == 0) continue;
    float* column = electrons.data() + u;
    for (int v = 0; v < height; ++v) {
      // One run of full pixels: its whole excess leaves at the two ends.
      float excess = 0;
      const int begin = v;
      for (; v < height && column[static_cast<std::ptrdiff_t>(v) * width] > full_well; ++v) {
        float& pixel = column[static_cast<std::ptrdiff_t>(v) * width];
        excess += pixel - full_well;
        pixel = full_well;
      }
      if (excess <= 0) continue;
      spill(0.5F * share * excess, begin - 1, -1, width, height, full_well, column);
      spill(0.5F * share * excess, v, 1, width, height, full_well, column);
    }
  }
}

namespace {

// The Poisson number of electrons is drawn by its third-order Cornish-Fisher expansion, λ + √λ z + (z² −
// 1)/6, whose mean is λ, variance λ + 1/18 and third cumulant λ + 1/27. The 1/18 is taken out of the read
// noise, so that the sum has the right mean, variance and skewness; rounding to whole electrons is lost in
// the read noise.
template <class Pixel>
void read_linear(const Sensor& sensor, std::span<const float> mean, std::span<const float> offsets,
                 const RandomSequence& sequence, std::uint64_t first, std::span<Pixel> grey) {
  const NormalTable& normal = normal_table();
  const double read_variance = std::max(0.0, sensor.read_noise * sensor.read_noise - 1.0 / 18.0);
  const auto read_noise = static_cast<float>(std::sqrt(read_variance));
  const auto full_well = static_cast<float>(sensor.full_well);
  const auto per_electron = static_cast<float>(1.0 / sensor.gain);
  const auto offset = static_cast<float>(sensor.black_level) + 0.5F;  // + ½: truncation rounds
  const auto white = static_cast<float>(sensor.white_level());
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const std::uint64_t bits = sequence[first + i];
    const float z = normal(static_cast<std::uint32_t>(bits));
    const float y = normal(static_cast<std::uint32_t>(bits >> 32U));
    const float lambda = mean[i];
    const float electrons = lambda + std::sqrt(lambda) * z + (z * z - 1.0F) * (1.0F / 6.0F);
    const float level = (std::min(electrons, full_well) + read_noise * y) * per_electron + offset +
                        (offsets.empty() ? 0.0F : offsets[i]);
    grey[i] = static_cast<Pixel>(std::clamp(level, 0.0F, white));
  }
}

template <class Pixel>
void read_logarithmic(const Sensor& sensor, std::span<const float> mean, std::span<const float> offsets,
                      const RandomSequence& sequence, std::uint64_t first, std::span<Pixel> grey) {
  const NormalTable& normal = normal_table();
  const LogPixel pixel = sensor.log_pixel();
  const auto white = static_cast<float>(sensor.white_level());
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const float z = normal(static_cast<std::uint32_t>(sequence[first + i]));
    const float level = static_cast<float>(pixel.level(mean[i])) +
                        static_cast<float>(pixel.noise(mean[i])) * z + (offsets.empty() ? 0.0F : offsets[i]) +
                        0.5F;
    grey[i] = static_cast<Pixel>(std::clamp(level, 0.0F, white));
  }
}

}  // namespace

template <class Pixel>
void read_out(const Sensor& sensor, std::span<const float> mean, std::span<const float> offsets,
              const RandomSequence& sequence, std::uint64_t first, std::span<Pixel> grey) {
  if (sensor.logarithmic) {
    read_logarithmic(sensor, mean, offsets, sequence, first, grey);
  } else {
    read_linear(sensor, mean, offsets, sequence, first, grey);
  }
}

template void read_out<std::uint8_t>(const Sensor&, std::span<const float>, std::span<const float>,
                                     const RandomSequence&, std::uint64_t, std::span<std::uint8_t>);
template void read_out<std::uint16_t>(const Sensor&, std::span<const float>, std::span<const float>,
                                      const RandomSequence&, std::uint64_t, std::span<std::uint16_t>);

}  // namespace omma::sim
