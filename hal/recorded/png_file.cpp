// PNG in and out, by libspng.
#include <spng.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

// A white level below the format's largest (a 12-bit sensor's 4095) is kept in a text record of this name.
constexpr std::string_view kWhiteLevelKeyword = "White level";
constexpr std::size_t kMaxChunkBytes = std::size_t{64} << 20;

struct ContextFree {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, ContextFree>;

class PngReader {
 public:
  PngReader(std::span<const std::byte> bytes, const std::string& file)
      : file_(file), context_(spng_ctx_new(0)) {
    if (!context_) throw std::bad_alloc();
    check(spng_set_image_limits(context_.get(), kImageFileSide, kImageFileSide));
    check(spng_set_chunk_limits(context_.get(), kMaxChunkBytes, kMaxChunkBytes));
    check(spng_set_png_buffer(context_.get(), bytes.data(), bytes.size()));
    check(spng_get_ihdr(context_.get(), &header_));
  }

  void read(Image& image) {
    const int width = static_cast<int>(header_.width);
    const int height = static_cast<int>(header_.height);
    const bool sixteen = header_.bit_depth == 16;
    switch (header_.color_type) {
      case SPNG_COLOR_TYPE_GRAYSCALE:
        image.resize(width, height, sixteen ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
        decode(image.pixels, sixteen ? SPNG_FMT_PNG : SPNG_FMT_G8);
        break;
      case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
        image.resize(width, height, sixteen ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
        without_opacity(image, sixteen ? 2 : 1);
        break;
      default:
        image.resize(width, height, PixelFormat::kGrey8);
        luminance(image);
    }
    // To the very end, so that a file cut behind the pixels is noticed too.
    check(spng_decode_chunks(context_.get()));
    if (image.format == PixelFormat::kGrey16) image.white_level = white_level();
  }

 private:
  void check(int error) const {
    if (error != 0) throw InputError(file_, 0, "PNG", "a whole image", spng_strerror(error));
  }

  void decode(std::span<std::byte> pixels, int format) const {
    std::size_t size = 0;
    check(spng_decoded_image_size(context_.get(), format, &size));
    if (size != pixels.size()) throw InputError(file_, 0, "PNG", "a whole image", "another size");
    check(spng_decode_image(context_.get(), pixels.data(), size, format, 0));
  }

  // Grey and opacity, each of `sample` bytes: every second sample.
  void without_opacity(Image& image, std::size_t sample) const {
    std::vector<std::byte> both(image.pixels.size() * 2);
    decode(both, SPNG_FMT_PNG);
    for (std::size_t i = 0; i < image.pixels.size() / sample; ++i) {
      std::memcpy(&image.pixels[i * sample], &both[2 * i * sample], sample);
    }
  }

  void luminance(Image& image) const {
    std::vector<std::byte> rgb(image.pixels.size() * 3);
    decode(rgb, SPNG_FMT_RGB8);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const auto value = [&](std::size_t k) { return std::to_integer<unsigned>(rgb[3 * i + k]); };
      // Rec. 601 in parts of 2¹⁶, rounded.
      image.pixels[i] =
          static_cast<std::byte>((19595 * value(0) + 38470 * value(1) + 7471 * value(2) + 32768) >> 16);
    }
  }

  std::uint16_t white_level() const {
    std::uint32_t count = 0;
    if (spng_get_text(context_.get(), nullptr, &count) != 0) return 65535;
    std::vector<spng_text> texts(count);
    if (spng_get_text(context_.get(), texts.data(), &count) != 0) return 65535;
    for (const spng_text& text : texts) {
      if (text.keyword != kWhiteLevelKeyword) continue;
      const std::string_view value(text.text, text.length);
      std::uint16_t level = 0;
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), level);
      if (error != std::errc{} || end != value.data() + value.size() || level == 0) {
        throw InputError(file_, 0, "PNG white level", "a number from 1 to 65535", "another text");
      }
      return level;
    }
    return 65535;
  }

  const std::string& file_;
  Context context_;
  spng_ihdr header_{};
};

void check_encoding(int error) {
  if (error != 0) throw std::runtime_error(std::string("PNG encoder: ") + spng_strerror(error));
}

std::vector<std::byte> encode(int width, int height, int bit_depth, int color_type,
                              std::span<const std::byte> pixels, std::uint16_t white_level,
                              PngEffort effort) {
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
  if (!context) throw std::bad_alloc();
  check_encoding(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
  if (effort == PngEffort::kFast) {
    check_encoding(spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 1));
    check_encoding(spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP));
  }
  if (effort == PngEffort::kStored) {
    check_encoding(spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 0));
    check_encoding(spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_DISABLE_FILTERING));
  }
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = static_cast<std::uint8_t>(bit_depth);
  header.color_type = static_cast<std::uint8_t>(color_type);
  check_encoding(spng_set_ihdr(context.get(), &header));

  std::array<char, 8> digits{};
  spng_text text{};
  if (white_level < (bit_depth == 16 ? 65535 : 255)) {
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), white_level).ptr;
    std::copy(kWhiteLevelKeyword.begin(), kWhiteLevelKeyword.end(), text.keyword);
    text.type = SPNG_TEXT;
    text.text = digits.data();
    text.length = static_cast<std::size_t>(end - digits.data());
    check_encoding(spng_set_text(context.get(), &text, 1));
  }
  check_encoding(
      spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int error = 0;
  // The buffer is malloc's and ours to free.
  const std::unique_ptr<void, decltype(&std::free)> buffer(spng_get_png_buffer(context.get(), &size, &error),
                                                           &std::free);
  check_encoding(error);
  const auto* bytes = static_cast<const std::byte*>(buffer.get());
  return {bytes, bytes + size};
}

void write(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.flush();
  if (!stream)
    throw InputError(file.string(), 0, "file", "a place to write to", "one that cannot be written");
}

}  // namespace

void read_png(std::span<const std::byte> bytes, const std::string& file, Image& image) {
  PngReader(bytes, file).read(image);
}

ImageSize read_png_size(const std::filesystem::path& file) {
  std::array<std::byte, 33> head{};  // signature and IHDR
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(head.data()), head.size());
  if (!stream) throw InputError(file.string(), 0, "PNG", "a whole image", "an unreadable or short file");
  const std::string name = file.string();
  const Context context(spng_ctx_new(0));
  if (!context) throw std::bad_alloc();
  spng_ihdr header{};
  int error = spng_set_png_buffer(context.get(), head.data(), head.size());
  if (error == 0) error = spng_get_ihdr(context.get(), &header);
  if (error != 0) throw InputError(name, 0, "PNG", "a whole image", spng_strerror(error));
  const bool grey =
      header.color_type == SPNG_COLOR_TYPE_GRAYSCALE || header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
  return {static_cast<int>(header.width), static_cast<int>(header.height),
          grey && header.bit_depth == 16 ? 16 : 8};
}

std::vector<std::byte> encode_png(const ImageView& image, PngEffort effort) {
  if (image.empty()) throw std::invalid_argument("an image without pixels");
  const std::size_t row_bytes =
      static_cast<std::size_t>(image.width) * (image.format == PixelFormat::kGrey8 ? 1 : 2);
  std::vector<std::byte> packed(row_bytes * static_cast<std::size_t>(image.height));
  for (int v = 0; v < image.height; ++v) {
    std::copy_n(image.data + v * image.stride, row_bytes, &packed[static_cast<std::size_t>(v) * row_bytes]);
  }
  const int bits = image.format == PixelFormat::kGrey8 ? 8 : 16;
  return encode(image.width, image.height, bits, SPNG_COLOR_TYPE_GRAYSCALE, packed, image.white_level,
                effort);
}

std::vector<std::byte> encode_png_rgb(int width, int height, std::span<const std::uint8_t> rgb,
                                      PngEffort effort) {
  if (width <= 0 || height <= 0 ||
      rgb.size() != std::size_t{3} * static_cast<unsigned>(width) * static_cast<unsigned>(height)) {
    throw std::invalid_argument("a colour image whose size is not 3 width height");
  }
  return encode(width, height, 8, SPNG_COLOR_TYPE_TRUECOLOR, std::as_bytes(rgb), 255, effort);
}

void write_png(const std::filesystem::path& file, const ImageView& image, PngEffort effort) {
  write(file, encode_png(image, effort));
}

void write_png_rgb(const std::filesystem::path& file, int width, int height,
                   std::span<const std::uint8_t> rgb, PngEffort effort) {
  write(file, encode_png_rgb(width, height, rgb, effort));
}

}  // namespace omma
