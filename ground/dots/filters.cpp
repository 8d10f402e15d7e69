#include "ground/dots/filters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace omma::ground {
namespace {

// Applies `rule` to the 3×3 neighbourhood of every pixel, row by row.
template <class Rule>
GreyImage by_neighbours(const GreyImage& image, Rule&& rule) {
  GreyImage out(image.width, image.height);
  std::array<float, 9> n{};
  for (int v = 0; v < image.height; ++v) {
    const std::array<int, 3> rows{std::max(0, v - 1), v, std::min(image.height - 1, v + 1)};
    for (int u = 0; u < image.width; ++u) {
      const std::array<int, 3> columns{std::max(0, u - 1), u, std::min(image.width - 1, u + 1)};
      for (std::size_t k = 0; k < 9; ++k) n[k] = image.at(columns[k % 3], rows[k / 3]);
      out.at(u, v) = rule(n);
    }
  }
  return out;
}

GreyImage erode(const GreyImage& image) {
  return by_neighbours(image, [](const auto& n) { return *std::min_element(n.begin(), n.end()); });
}

// Fourier transform of every row, and back where `inverse`.
using Spectrum = std::vector<std::complex<float>>;
void transform_lines(Spectrum& data, std::size_t lines, std::size_t length, std::size_t line_step,
                     std::size_t step, bool inverse) {
  Eigen::FFT<float> fft;
  Spectrum in(length), out(length);
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::size_t i = 0; i < length; ++i) in[i] = data[line * line_step + i * step];
    if (inverse) {
      fft.inv(out, in);
    } else {
      fft.fwd(out, in);
    }
    for (std::size_t i = 0; i < length; ++i) data[line * line_step + i * step] = out[i];
  }
}

}  // namespace

GreyImage grey_image(const ImageView& image) {
  GreyImage grey(image.width, image.height);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      grey.at(u, v) = image.format == PixelFormat::kGrey8
                          ? static_cast<float>(image.row<std::uint8_t>(v)[u])
                          : static_cast<float>(image.row<std::uint16_t>(v)[u]);
  return grey;
}

GreyImage power_look_up(const GreyImage& image, double power) {
  GreyImage out = image;
  const float top = *std::max_element(image.value.begin(), image.value.end());
  if (!(top > 0)) return out;
  for (float& x : out.value)
    x = static_cast<float>(top * std::pow(std::max(0.0F, x) / static_cast<double>(top), power));
  return out;
}

GreyImage local_threshold(const GreyImage& image, int window, double deviations) {
  // Sums over windows from sums over everything above and left.
  const int w = image.width, h = image.height;
  const auto index = [w](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(w + 1) + static_cast<std::size_t>(u);
  };
  std::vector<double> sum(index(0, h + 1)), square(index(0, h + 1));
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      const double x = image.at(u, v);
      sum[index(u + 1, v + 1)] = x + sum[index(u, v + 1)] + sum[index(u + 1, v)] - sum[index(u, v)];
      square[index(u + 1, v + 1)] =
          x * x + square[index(u, v + 1)] + square[index(u + 1, v)] - square[index(u, v)];
    }
  }
  GreyImage out(w, h);
  for (int v = 0; v < h; ++v) {
    const int top = std::max(0, v - window / 2), bottom = std::min(h, v + window / 2 + 1);
    for (int u = 0; u < w; ++u) {
      const int left = std::max(0, u - window / 2), right = std::min(w, u + window / 2 + 1);
      const double n = static_cast<double>(right - left) * (bottom - top);
      const auto total = [&](const std::vector<double>& s) {
        return s[index(right, bottom)] - s[index(left, bottom)] - s[index(right, top)] + s[index(left, top)];
      };
      const double mean = total(sum) / n;
      const double deviation = std::sqrt(std::max(0.0, total(square) / n - mean * mean));
      // The small margin keeps rounding from lighting even areas.
      out.at(u, v) = image.at(u, v) > mean + deviations * deviation + 1e-4 * std::abs(mean) + 1e-6 ? 1 : 0;
    }
  }
  return out;
}

GreyImage median_filter(const GreyImage& image, int window) {
  GreyImage out(image.width, image.height);
  std::vector<float> values;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      values.clear();
      for (int y = v - window / 2; y <= v + window / 2; ++y)
        for (int x = u - window / 2; x <= u + window / 2; ++x)
          values.push_back(image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1)));
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      out.at(u, v) = *middle;
    }
  }
  return out;
}

GreyImage remove_low_frequencies(const GreyImage& image, double part) {
  const auto w = static_cast<std::size_t>(image.width), h = static_cast<std::size_t>(image.height);
  Spectrum spectrum(image.value.begin(), image.value.end());
  transform_lines(spectrum, h, w, w, 1, false);
  transform_lines(spectrum, w, h, 1, w, false);
  for (std::size_t v = 0; v < h; ++v) {
    for (std::size_t u = 0; u < w; ++u) {
      const auto along_u = static_cast<double>(std::min(u, w - u)) / (0.5 * static_cast<double>(w));
      const auto along_v = static_cast<double>(std::min(v, h - v)) / (0.5 * static_cast<double>(h));
      if (along_u < part && along_v < part) spectrum[v * w + u] = 0;
    }
  }
  transform_lines(spectrum, w, h, 1, w, true);
  transform_lines(spectrum, h, w, w, 1, true);
  GreyImage out(image.width, image.height);
  for (std::size_t i = 0; i < out.value.size(); ++i) out.value[i] = spectrum[i].real();
  return out;
}

GreyImage gaussian_smooth(const GreyImage& image, double sigma) {
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> weight;
  float sum = 0;
  for (int k = -radius; k <= radius; ++k) {
    weight.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    sum += weight.back();
  }
  for (float& w : weight) w /= sum;
  const auto of = [&](int k) { return *(weight.begin() + radius + k); };
  GreyImage across(image.width, image.height), out(image.width, image.height);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      for (int k = -radius; k <= radius; ++k)
        across.at(u, v) += of(k) * image.at(std::clamp(u + k, 0, image.width - 1), v);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      for (int k = -radius; k <= radius; ++k)
        out.at(u, v) += of(k) * across.at(u, std::clamp(v + k, 0, image.height - 1));
  return out;
}

GreyImage sobel(const GreyImage& image) {
  return by_neighbours(image, [](const auto& n) {
    const float du = n[2] + 2 * n[5] + n[8] - n[0] - 2 * n[3] - n[6];
    const float dv = n[6] + 2 * n[7] + n[8] - n[0] - 2 * n[1] - n[2];
    return std::sqrt(du * du + dv * dv);
  });
}

GreyImage highlight_details(const GreyImage& image) {
  return by_neighbours(image, [](const auto& n) {
    float around = 0;
    for (const float x : n) around += x;
    return std::max(0.0F, n[4] + (8 * n[4] - (around - n[4])));
  });
}

GreyImage dilate(const GreyImage& image) {
  return by_neighbours(image, [](const auto& n) { return *std::max_element(n.begin(), n.end()); });
}

GreyImage close(const GreyImage& image) {
  return erode(dilate(image));
}

GreyImage subtract(const GreyImage& image, const GreyImage& other) {
  GreyImage out = image;
  for (std::size_t i = 0; i < out.value.size(); ++i) out.value[i] -= other.value[i];
  return out;
}

GreyImage masked(const GreyImage& image, const GreyImage& mask) {
  GreyImage out = image;
  for (std::size_t i = 0; i < out.value.size(); ++i)
    if (mask.value[i] == 0) out.value[i] = 0;
  return out;
}

}  // namespace omma::ground
