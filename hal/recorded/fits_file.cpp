// FITS in, by cfitsio (Pence et al., FITS standard 4.0): one grey image of 8 or 16 bits.
#include <fitsio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

class FitsReader {
 public:
  FitsReader(std::span<const std::byte> bytes, const std::string& file)
      : file_(file), memory_(const_cast<std::byte*>(bytes.data())), size_(bytes.size()) {
    // Opened for reading only: the memory is neither written nor grown.
    int status = 0;
    fits_open_memfile(&fits_, "image.fits", READONLY, &memory_, &size_, 0, nullptr, &status);
    check(status);
  }
  ~FitsReader() {
    int status = 0;
    if (fits_ != nullptr) fits_close_file(fits_, &status);
  }
  FitsReader(const FitsReader&) = delete;
  FitsReader& operator=(const FitsReader&) = delete;

  void read(Image& image) {
    find_image();
    if (type_ == BYTE_IMG) {
      image.resize(width_, height_, PixelFormat::kGrey8);
      read_pixels(TBYTE, image.pixels.data());
    } else if (type_ == USHORT_IMG) {
      image.resize(width_, height_, PixelFormat::kGrey16);
      read_pixels(TUSHORT, image.pixels.data());
    } else {
      read_scaled(image);
    }
    if (!top_down()) turn_upright(image);
  }

 private:
  void check(int status) const {
    if (status == 0) return;
    std::array<char, FLEN_STATUS> text{};
    fits_get_errstatus(status, text.data());
    fits_clear_errmsg();
    throw InputError(file_, 0, "FITS", "a whole image", text.data());
  }

  // The first two-dimensional image: an extension where the primary one is empty or compressed in tiles.
  void find_image() {
    int status = 0;
    int count = 0;
    fits_get_num_hdus(fits_, &count, &status);
    check(status);
    for (int i = 1; i <= count; ++i) {
      int kind = 0;
      fits_movabs_hdu(fits_, i, &kind, &status);
      check(status);
      if (kind != IMAGE_HDU && fits_is_compressed_image(fits_, &status) == 0) continue;
      int axes = 0;
      std::array<long, 3> sides{1, 1, 1};
      fits_get_img_param(fits_, 3, &type_, &axes, sides.data(), &status);
      check(status);
      if (axes < 2 || axes > 3 || sides[2] != 1) continue;
      if (*std::max_element(sides.begin(), sides.end()) > kImageFileSide || sides[0] < 1 || sides[1] < 1) {
        throw InputError(file_, 0, "FITS", "sides of 1 to " + std::to_string(kImageFileSide) + " px",
                         "another size");
      }
      fits_get_img_equivtype(fits_, &type_, &status);  // with BZERO and BSCALE
      check(status);
      width_ = static_cast<int>(sides[0]);
      height_ = static_cast<int>(sides[1]);
      require_data();
      return;
    }
    throw InputError(file_, 0, "FITS", "a two-dimensional grey image", "none");
  }

  // cfitsio may read past the end of a short file in memory without a word: the data unit must lie inside.
  void require_data() const {
    int status = 0;
    LONGLONG start = 0;
    LONGLONG end = 0;
    fits_get_hduaddrll(fits_, nullptr, &start, &end, &status);
    check(status);
    int stored_bits = 0;
    int naxis = 0;
    std::array<LONGLONG, 3> sides{1, 1, 1};
    int compressed = fits_is_compressed_image(fits_, &status);
    LONGLONG needed = end;
    if (compressed == 0) {
      fits_get_img_paramll(fits_, 3, &stored_bits, &naxis, sides.data(), &status);
      needed = start + sides[0] * sides[1] * std::abs(stored_bits) / 8;
    }
    check(status);
    if (needed > static_cast<LONGLONG>(size_)) check(END_OF_FILE);
  }

  void read_pixels(int type, void* pixels) const {
    int status = 0;
    std::array<long, 3> first{1, 1, 1};
    fits_read_pix(fits_, type, first.data(), LONGLONG{width_} * height_, nullptr, pixels, nullptr, &status);
    check(status);
  }

  void read_scaled(Image& image) const {
    std::vector<double> values(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    int status = 0;
    std::array<long, 3> first{1, 1, 1};
    double blank = std::numeric_limits<double>::quiet_NaN();
    int any_blank = 0;  // not used, but cfitsio writes it
    fits_read_pix(fits_, TDOUBLE, first.data(), LONGLONG{width_} * height_, &blank, values.data(), &any_blank,
                  &status);
    check(status);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (!(least <= most)) throw InputError(file_, 0, "FITS", "an image", "no pixel with a finite value");
    // Grey levels keep their units; fractions and what does not fit is spread over the range.
    const bool fits_as_it_is = least >= 0 && most <= 65535 && (type_ > 0 || most > 1);
    const double offset = fits_as_it_is ? 0 : least;
    const double scale = fits_as_it_is || most == least ? 1 : 65535 / (most - least);
    image.resize(width_, height_, PixelFormat::kGrey16);
    auto* const pixels = reinterpret_cast<std::uint16_t*>(image.pixels.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double value = std::isfinite(values[i]) ? values[i] : least;
      pixels[i] = static_cast<std::uint16_t>(std::lround(std::clamp((value - offset) * scale, 0.0, 65535.0)));
    }
    if (type_ == SHORT_IMG && fits_as_it_is) image.white_level = 32767;
  }

  bool top_down() const {
    int status = 0;
    std::array<char, FLEN_VALUE> order{};
    fits_read_key(fits_, TSTRING, "ROWORDER", order.data(), nullptr, &status);
    fits_clear_errmsg();
    return status == 0 && std::string_view(order.data()) == "TOP-DOWN";
  }

  static void turn_upright(Image& image) {
    const std::ptrdiff_t row = std::ptrdiff_t{image.width} * image.bytes_per_pixel();
    for (int v = 0; v < image.height / 2; ++v) {
      std::byte* const upper = image.pixels.data() + v * row;
      std::swap_ranges(upper, upper + row, image.pixels.data() + (image.height - 1 - v) * row);
    }
  }

  const std::string& file_;
  void* memory_;
  std::size_t size_;
  fitsfile* fits_ = nullptr;
  int type_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace

void read_fits(std::span<const std::byte> bytes, const std::string& file, Image& image) {
  FitsReader(bytes, file).read(image);
}

}  // namespace omma
