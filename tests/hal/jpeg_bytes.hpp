// A grey image as the bytes of a JPEG file, as a camera would send it.
#pragma once

#include <cstdio>
// libjpeg's header needs FILE declared before it.
#include <jpeglib.h>

#include <cstdlib>
#include <vector>

#include "hal/recorded/image_file.hpp"

namespace omma::test {

inline std::vector<std::byte> jpeg_of(const Image& grey) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &buffer, &size);
  info.image_width = static_cast<JDIMENSION>(grey.width);
  info.image_height = static_cast<JDIMENSION>(grey.height);
  info.input_components = 1;
  info.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 98, TRUE);
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    auto* row = reinterpret_cast<JSAMPROW>(
        const_cast<std::byte*>(grey.pixels.data() + std::size_t{info.next_scanline} * info.image_width));
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  const auto* const bytes = reinterpret_cast<const std::byte*>(buffer);
  std::vector<std::byte> result(bytes, bytes + size);
  jpeg_destroy_compress(&info);
  std::free(buffer);
  return result;
}

}  // namespace omma::test
