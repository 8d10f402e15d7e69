// Frame correction: a raw frame of one sensor to the one in which dots are looked for: less the black frame,
// hot pixels filled in, grey levels made even. Formulas in docs/algorithms/sensor.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/sensor/black_frame.hpp"
#include "components/sensor/response_curve.hpp"
#include "hal/image.hpp"

namespace omma {

/// What is known of a sensor before flight.
struct SensorCalibration {
  BlackFrame black;        ///< empty: none is taken away
  ResponseCurve response;  ///< empty: even
  double black_level =
      0;  ///< of a sensor without black frame, where its response keeps its slope [grey levels]
  /// Ageing of the black frame, grey levels a visit of a pixel; 0: it stays as the file says.
  double ageing_step = 0;
};

class FrameCorrection {
 public:
  static constexpr int kAgedRows = 16;  ///< one row of so many ages in a frame

  /// For frames of exactly this size; the calibration's black frame has it too.
  FrameCorrection(int width, int height, const SensorCalibration& calibration);

  /// @return the corrected frame, valid until the next call; the raw one itself where nothing is to be done
  /// or
  ///         the size is another
  ImageView correct(const ImageView& raw) noexcept;
  /// Pixels whose value in the corrected frame is made up from their neighbours; null where there are none.
  const PixelMask* bad_pixels() const { return hot_.empty() ? nullptr : &black_.hot; }
  bool ages() const { return step_ > 0 && !black_.empty(); }
  /// Moves the black frame of row v by one step towards what the last corrected frame shows over its local
  /// background: the running median of what stays on the pixel. For frames whose sky has moved.
  /// @param level  local background of the row in the corrected frame, one a pixel
  void age_row(int v, const float* level) noexcept;

  double black_level() const { return pedestal_; }  ///< in the corrected frame [even grey levels]
  /// Black frame of one pixel as it is now [raw grey levels].
  float black(int u, int v) const { return black_.mean[at(u, v)]; }

 private:
  struct HotPixel {
    int u, v;
    std::array<std::array<int, 2>, 4> beside;  // columns and rows of neighbours that are not hot
    int count;
  };

  std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }
  void list_hot_pixels();
  template <class Raw, class Out>
  void correct_rows(const ImageView& raw) noexcept;
  template <class Out>
  void fill_in_hot() noexcept;

  int width_, height_;
  BlackFrame black_;
  ResponseCurve response_;
  double pedestal_;
  float step_;
  std::vector<float> drift_;          // of the black frame since the file, per pixel
  std::vector<std::int16_t> offset_;  // taken away from the raw pixel, the pedestal left
  std::vector<std::uint16_t> even_;   // by raw level less black
  std::uint16_t white_ = 0;           // that even_ was made for
  std::vector<HotPixel> hot_;
  std::vector<std::byte> pixels_;
  ImageView corrected_;
};

}  // namespace omma
