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

// The chunk's pixels into rows_.
bool ChunkPictures::decode(const omma_ImageChunk& chunk) {
  const std::size_t size = std::size_t{chunk.rows} * chunk.width_px;
  if (size == 0 || chunk.first_row + chunk.rows > chunk.height_px) return false;
  rows_.resize(size);
  const std::span<const std::uint8_t> bytes(chunk.pixels._buffer, chunk.pixels._length);
  if (chunk.encoding == omma_ENCODING_PREDICTED_ZSTD)
    return decode_rows(bytes, chunk.width_px, chunk.rows, rows_);
  if (chunk.encoding != omma_ENCODING_GREY || bytes.size() != size) return false;
  std::copy(bytes.begin(), bytes.end(), rows_.begin());
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
      picture->picture = {chunk.width_px, chunk.height_px, {}};
      picture->picture.pixels.resize(std::size_t{chunk.width_px} * chunk.height_px, 0);
      picture->rows.resize(chunk.height_px, false);
      picture->first_frame = picture->last_frame = chunk.frame;
    }
  }
  if (picture == nullptr || picture->picture.width != chunk.width_px ||
      picture->picture.height != chunk.height_px || picture->kind != chunk.kind) {
    ++refused_;
    return;
  }
  std::copy(rows_.begin(), rows_.end(),
            picture->picture.pixels.begin() + static_cast<std::ptrdiff_t>(chunk.first_row) * chunk.width_px);
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
