#include "hal/recorded/image_file.hpp"

#include <cstring>
#include <fstream>
#include <string_view>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

}  // namespace

void Image::resize(int new_width, int new_height, PixelFormat new_format) {
  width = new_width;
  height = new_height;
  format = new_format;
  white_level = format == PixelFormat::kGrey8 ? 255 : 65535;
  pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                static_cast<std::size_t>(bytes_per_pixel()));
}

void read_bytes(const std::filesystem::path& file, std::vector<std::byte>& bytes) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw InputError(file.string(), 0, "file", "an image", "no such file");
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(file.string(), 0, "file", "an image", "something else of that name");
  }
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  if (size >= 0) {
    bytes.resize(static_cast<std::size_t>(size));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), size);
  }
  if (!stream) throw InputError(file.string(), 0, "file", "a readable file", "one that cannot be read");
}

void read_image_bytes(std::span<const std::byte> bytes, const std::string& file, Image& image) {
  if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) {
    read_png(bytes, file, image);
  } else if (starts_with(bytes, "\xff\xd8\xff")) {
    read_jpeg(bytes, file, image);
  } else if (starts_with(bytes, "SIMPLE  =")) {
    read_fits(bytes, file, image);
  } else {
    throw InputError(file, 0, "file", "a PNG, JPEG or FITS image",
                     bytes.empty() ? "an empty file" : "another kind of file");
  }
}

Image image_from_bytes(std::span<const std::byte> bytes, const std::string& file) {
  Image image;
  read_image_bytes(bytes, file, image);
  return image;
}

ImageSize read_image_size(const std::filesystem::path& file) {
  if (file.extension() == ".png") return read_png_size(file);
  const Image image = read_image(file);
  return {image.width, image.height, 8 * image.bytes_per_pixel()};
}

Image read_image(const std::filesystem::path& file) {
  std::vector<std::byte> bytes;
  read_bytes(file, bytes);
  return image_from_bytes(bytes, file.string());
}

}  // namespace omma
