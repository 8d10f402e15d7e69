// JPEG out, by libjpeg. Apart from the reader, which is all that the flight program links.
#include <cstdio>
// libjpeg's header needs FILE declared before it.
#include <jpeglib.h>

#include <cstdlib>

#include "hal/recorded/image_file.hpp"

namespace omma {

std::vector<std::byte> encode_jpeg(const ImageView& grey, int quality) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);  // ends the program: only where there is no memory
  jpeg_create_compress(&info);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &buffer, &size);
  info.image_width = static_cast<JDIMENSION>(grey.width);
  info.image_height = static_cast<JDIMENSION>(grey.height);
  info.input_components = 1;
  info.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    // libjpeg does not write into the row, but its type does not say so.
    auto* row = const_cast<JSAMPROW>(grey.row<std::uint8_t>(static_cast<int>(info.next_scanline)));
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  const auto* const bytes = reinterpret_cast<const std::byte*>(buffer);
  std::vector<std::byte> jpeg(bytes, bytes + size);
  jpeg_destroy_compress(&info);
  std::free(buffer);
  return jpeg;
}

}  // namespace omma
