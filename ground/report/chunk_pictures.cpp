#include "ground/report/chunk_pictures.hpp"

#include <algorithm>
#include <span>

#include "components/imaging/image_coder.hpp"

namespace omma::ground {

bool ChunkPicture::complete() const {
  return std::all_of(rows.begin(), rows.end(), [](bool there) { return there; });
}

int ChunkPicture::rows_there() const {
  return static_cast<int>(std::count(rows.begin(), rows.end(), true));
}

// The chunk's levels into rows_.
bool ChunkPictures::decode(const omma_ImageChunk& chunk) {
  const std::size_t size = std::size_t{chunk.rows} * chunk.width_px;
  const bool wide = chunk.bits > 8;
  if (size == 0 || chunk.first_row + chunk.rows > chunk.height_px || chunk.bits < 8 || chunk.bits > 16)
    return false;
  rows_.resize(size);
  bytes_.resize(size);
  const std::span<const std::uint8_t> bytes(chunk.pixels._buffer, chunk.pixels._length);
  if (chunk.encoding == omma_ENCODING_PREDICTED_ZSTD) {
    if (wide) return decode_rows(bytes, chunk.width_px, chunk.rows, rows_);
    if (!decode_rows(bytes, chunk.width_px, chunk.rows, bytes_)) return false;
    std::copy(bytes_.begin(), bytes_.end(), rows_.begin());
    return true;
  }
  if (chunk.encoding != omma_ENCODING_GREY || bytes.size() != (wide ? 2 * size : size)) return false;
  for (std::size_t i = 0; i < size; ++i)
    rows_[i] = wide ? static_cast<std::uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8)) : bytes[i];
  return true;
}

void ChunkPictures::take(const omma_ImageChunk& chunk) {
  if (!chunk.valid) return;
  ChunkPicture* picture = nullptr;
  if (decode(chunk)) {
    const auto [at, fresh] = pictures_.try_emplace(chunk.image);
    picture = &at->second;
    if (fresh) {
      picture->kind = chunk.kind;
      picture->composite = chunk.composite;
      picture->composed = chunk.composed;
      picture->camera = chunk.camera;
      picture->left = chunk.left_px;
      picture->top = chunk.top_px;
      picture->pan = chunk.pan_rad;
      picture->tilt = chunk.tilt_rad;
      picture->field = chunk.field_rad;
      picture->scale = {static_cast<ImageScale>(chunk.scale), chunk.bits, chunk.light_most, chunk.light_soft};
      picture->levels.resize(std::size_t{chunk.width_px} * chunk.height_px, 0);
      picture->picture = {chunk.width_px, chunk.height_px, {}};
      picture->picture.pixels.resize(std::size_t{chunk.width_px} * chunk.height_px, 0);
      picture->rows.resize(chunk.height_px, false);
      picture->first_frame = picture->last_frame = chunk.frame;
    }
  }
  if (picture == nullptr || picture->picture.width != chunk.width_px ||
      picture->picture.height != chunk.height_px || picture->kind != chunk.kind ||
      picture->scale.bits != chunk.bits) {
    ++refused_;
    return;
  }
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(chunk.first_row) * chunk.width_px;
  std::copy(rows_.begin(), rows_.end(), picture->levels.begin() + first);
  std::transform(rows_.begin(), rows_.end(), picture->picture.pixels.begin() + first,
                 [&chunk](std::uint16_t level) {
                   const int seen = level > 0 ? 1 : 0;  // stays so in the upper bits
                   return static_cast<std::uint8_t>(std::max(seen, level >> (chunk.bits - 8)));
                 });
  std::fill_n(picture->rows.begin() + chunk.first_row, chunk.rows, true);
  picture->bytes += chunk.pixels._length;
  picture->first_frame = std::min<std::uint64_t>(picture->first_frame, chunk.frame);
  picture->last_frame = std::max<std::uint64_t>(picture->last_frame, chunk.frame);
}

const ChunkPicture* ChunkPictures::last_complete(omma_ImageKind kind) const {
  for (auto at = pictures_.rbegin(); at != pictures_.rend(); ++at)
    if (at->second.kind == kind && at->second.complete()) return &at->second;
  return nullptr;
}

}  // namespace omma::ground
