// An image without its low spatial frequencies: those below a part of the highest along both axes are taken
// away, as a Fourier transform is truncated by a rectangle. Eigen's FFT; its tables and all memory are made
// at construction.
#pragma once

#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "components/extractor/classical/grey_image.hpp"

namespace omma {

class LowFrequencies {
 public:
  /// For images of exactly this size.
  LowFrequencies(int width, int height);

  /// @param part  of the highest frequency of each axis; the mean is among what is taken away
  void remove(GreyImage& image, double part) noexcept;

 private:
  using Complex = std::complex<float>;
  void keep_low_columns(std::size_t low_columns, double part) noexcept;

  std::size_t width_, height_, half_;  // half_: frequencies of a row, the others being their conjugates
  Eigen::FFT<float> fft_;
  std::vector<Complex> spectrum_;  // of the rows, `half_` to each
  std::vector<Complex> in_, out_;  // a line
};

}  // namespace omma
