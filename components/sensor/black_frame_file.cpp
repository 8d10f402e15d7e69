// FITS by cfitsio (Pence et al., FITS standard 4.0).
#include "components/sensor/black_frame_file.hpp"

#include <array>
#include <cmath>
#include <string>

#include "components/sensor/fits_handle.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr const char* kKind = "OMMA black frame";
constexpr const char* kNoise = "NOISE";
constexpr const char* kHot = "HOT";

void write_image(const FitsFile& file, int type, int pixel_type, const BlackFrame& black, void* pixels,
                 const char* name) {
  std::array<long, 2> sides{black.width, black.height};
  std::array<long, 2> first{1, 1};
  std::string order = "TOP-DOWN";
  file.call(
      [&](int* status) {
        fits_create_img(file.get(), type, 2, sides.data(), status);
        fits_write_key(file.get(), TSTRING, "ROWORDER", order.data(), "first row is the top one", status);
        if (name != nullptr) {
          std::string written = name;
          fits_write_key(file.get(), TSTRING, "EXTNAME", written.data(), nullptr, status);
        }
        fits_write_pix(file.get(), pixel_type, first.data(), LONGLONG{black.width} * black.height, pixels,
                       status);
      },
      "a file that can be written");
}

void require_size(const FitsFile& file, const char* name, int& width, int& height) {
  int axes = 0;
  std::array<long, 2> sides{};
  file.call([&](int* status) { fits_get_img_dim(file.get(), &axes, status); },
            "a black frame by omma blackframe");
  if (axes == 2) {
    file.call([&](int* status) { fits_get_img_size(file.get(), 2, sides.data(), status); }, "an image");
  }
  if (axes != 2 || sides[0] < 1 || sides[1] < 1 || sides[0] > limits::kImageSide ||
      sides[1] > limits::kImageSide) {
    throw file.error(name, "an image with sides of 1 to " + std::to_string(limits::kImageSide) + " px",
                     "another size");
  }
  if (width == 0) {
    width = static_cast<int>(sides[0]);
    height = static_cast<int>(sides[1]);
  }
  if (sides[0] != width || sides[1] != height) {
    throw file.error(name, std::to_string(width) + " x " + std::to_string(height) + " pixels, as the mean",
                     std::to_string(sides[0]) + " x " + std::to_string(sides[1]));
  }
}

std::vector<float> read_image(const FitsFile& file, const char* name, BlackFrame& black) {
  require_size(file, name, black.width, black.height);
  std::vector<float> pixels(static_cast<std::size_t>(black.width) * static_cast<std::size_t>(black.height));
  std::array<long, 2> first{1, 1};
  file.call(
      [&](int* status) {
        fits_read_pix(file.get(), TFLOAT, first.data(), static_cast<LONGLONG>(pixels.size()), nullptr,
                      pixels.data(), nullptr, status);
      },
      "a whole image");
  for (const float pixel : pixels) {
    if (!(pixel >= 0 && pixel <= 65535))
      throw file.error(name, "grey levels from 0 to 65535", "another number");
  }
  return pixels;
}

}  // namespace

void write_black_frame(const std::filesystem::path& file, const BlackFrame& black) {
  // Under another name first: a file that exists is whole.
  const std::filesystem::path part = file.string() + ".part";
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  FitsFile fits(part.string());
  fits.create();
  BlackFrame copy = black;  // the library wants pixels it might change
  write_image(fits, FLOAT_IMG, TFLOAT, black, copy.mean.data(), nullptr);
  std::string kind = kKind;
  int frames = black.frames;
  fits.call(
      [&](int* status) {
        fits_write_key(fits.get(), TSTRING, "CONTENT", kind.data(), "mean, noise and hot pixels", status);
        fits_write_key(fits.get(), TINT, "FRAMES", &frames, "dark frames it was made of", status);
      },
      "a file that can be written");
  write_image(fits, FLOAT_IMG, TFLOAT, black, copy.noise.data(), kNoise);
  std::vector<std::uint8_t> hot;
  for (int v = 0; v < black.height; ++v)
    for (int u = 0; u < black.width; ++u) hot.push_back(black.hot.at(u, v) ? 1 : 0);
  write_image(fits, BYTE_IMG, TBYTE, black, hot.data(), kHot);
  fits.close();
  std::error_code failed;
  std::filesystem::rename(part, file, failed);
  if (failed) throw InputError(file.string(), 0, "file", "a place that can be written", failed.message());
}

BlackFrame read_black_frame(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(file.string(), 0, "file", "a black frame (FITS)", "no such file");
  FitsFile fits(file.string());
  fits.open();
  std::array<char, FLEN_VALUE> kind{};
  int status = 0;
  fits_read_key(fits.get(), TSTRING, "CONTENT", kind.data(), nullptr, &status);
  fits_clear_errmsg();
  if (status != 0 || std::string_view(kind.data()) != kKind)
    throw fits.error("CONTENT", "a black frame as omma blackframe writes it", "another FITS file");
  BlackFrame black;
  fits.call([&](int* code) { fits_read_key(fits.get(), TINT, "FRAMES", &black.frames, nullptr, code); },
            "the number of frames");
  black.mean = read_image(fits, "mean", black);
  const auto part = [&](const char* name) {
    std::string wanted = name;
    fits.call([&](int* code) { fits_movnam_hdu(fits.get(), IMAGE_HDU, wanted.data(), 0, code); },
              "the parts NOISE and HOT");
    return read_image(fits, name, black);
  };
  black.noise = part(kNoise);
  const std::vector<float> hot = part(kHot);
  black.hot = PixelMask(black.width, black.height);
  for (std::size_t i = 0; i < hot.size(); ++i) {
    const int u = static_cast<int>(i) % black.width;
    const int v = static_cast<int>(i) / black.width;
    if (hot[i] != 0) black.hot.add_box(u, v, u, v);
  }
  return black;
}

}  // namespace omma
