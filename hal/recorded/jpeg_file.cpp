// JPEG in, by libjpeg: its luma is Rec. 601 luminance already.
#include <jerror.h>

#include <csetjmp>
#include <cstdio>
// libjpeg's header needs FILE declared before it.
#include <jpeglib.h>

#include <array>

#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

// libjpeg reports by calling back and must not return: back to the reader by longjmp.
struct ErrorHandler {
  jpeg_error_mgr base;
  std::jmp_buf reader;
  bool damaged;
};

ErrorHandler& handler_of(j_common_ptr info) {
  return *reinterpret_cast<ErrorHandler*>(info->err);
}

[[noreturn]] void on_error(j_common_ptr info) {
  std::longjmp(handler_of(info).reader, 1);
}

// libjpeg fills missing data with grey and only warns; such an image is not whole. Stray bytes between
// markers harm nothing and are common in cameras' files.
void on_message(j_common_ptr info, int level) {
  if (level < 0 && info->err->msg_code != JWRN_EXTRANEOUS_DATA && info->err->msg_code != JWRN_ADOBE_XFORM) {
    handler_of(info).damaged = true;
  }
}

struct Decompressor {
  Decompressor() = default;
  ~Decompressor() { jpeg_destroy_decompress(&info); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
  jpeg_decompress_struct info{};
};

// Memory is made by the caller between the header and the pixels; no object with a destructor lives in here.
enum class Outcome : std::uint8_t { kOk, kError, kColourSpace, kSize };

using Prepare = std::byte* (*)(void* image, int width, int height);

Outcome decode(std::span<const std::byte> bytes, Prepare prepare, void* image, jpeg_decompress_struct& info,
               ErrorHandler& handler) {
  info.err = jpeg_std_error(&handler.base);
  handler.base.error_exit = on_error;
  handler.base.emit_message = on_message;
  handler.damaged = false;
  if (setjmp(handler.reader) != 0)
    return Outcome::kError;  // NOLINT(modernize-avoid-setjmp-longjmp,cert-err52-cpp)
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  if (info.jpeg_color_space != JCS_GRAYSCALE && info.jpeg_color_space != JCS_YCbCr &&
      info.jpeg_color_space != JCS_RGB) {
    return Outcome::kColourSpace;
  }
  if (info.image_width > kImageFileSide || info.image_height > kImageFileSide) return Outcome::kSize;
  info.out_color_space = JCS_GRAYSCALE;
  std::byte* const pixels =
      prepare(image, static_cast<int>(info.image_width), static_cast<int>(info.image_height));
  jpeg_start_decompress(&info);
  while (info.output_scanline < info.output_height) {
    auto* row = reinterpret_cast<JSAMPROW>(pixels + std::size_t{info.output_scanline} * info.output_width);
    jpeg_read_scanlines(&info, &row, 1);
  }
  jpeg_finish_decompress(&info);
  return handler.damaged ? Outcome::kError : Outcome::kOk;
}

}  // namespace

void read_jpeg(std::span<const std::byte> bytes, const std::string& file, Image& image) {
  ErrorHandler handler{};
  Decompressor decompressor;
  const auto prepare = [](void* into, int width, int height) {
    auto* const target = static_cast<Image*>(into);
    target->resize(width, height, PixelFormat::kGrey8);
    return target->pixels.data();
  };
  const Outcome outcome = decode(bytes, prepare, &image, decompressor.info, handler);
  std::array<char, JMSG_LENGTH_MAX> message{};
  if (outcome == Outcome::kError)
    handler.base.format_message(reinterpret_cast<j_common_ptr>(&decompressor.info), message.data());
  if (outcome == Outcome::kError) throw InputError(file, 0, "JPEG", "a whole image", message.data());
  if (outcome == Outcome::kColourSpace)
    throw InputError(file, 0, "JPEG", "grey or colour (YCbCr, RGB)", "CMYK");
  if (outcome == Outcome::kSize) {
    throw InputError(file, 0, "JPEG", "sides of at most " + std::to_string(kImageFileSide) + " px",
                     "a larger image");
  }
}

}  // namespace omma
