#include "ground/report/chunk_pictures.hpp"

#include <algorithm>

namespace omma::ground {

bool ChunkPicture::complete() const {
  return std::all_of(rows.begin(), rows.end(), [](bool there) { return there; });
}

void ChunkPictures::take(const omma_ImageChunk& chunk) {
  if (!chunk.valid) return;
  const std::size_t bytes = std::size_t{chunk.rows} * chunk.width_px;
  const bool sound =
      bytes > 0 && bytes == chunk.pixels._length && chunk.first_row + chunk.rows <= chunk.height_px;
  ChunkPicture* picture = nullptr;
  if (sound) {
    const auto [at, fresh] = pictures_.try_emplace(chunk.image);
    picture = &at->second;
    if (fresh) {
      picture->kind = chunk.kind;
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
  std::copy_n(
      chunk.pixels._buffer, bytes,
      picture->picture.pixels.begin() + static_cast<std::ptrdiff_t>(chunk.first_row) * chunk.width_px);
  std::fill_n(picture->rows.begin() + chunk.first_row, chunk.rows, true);
  picture->first_frame = std::min<std::uint64_t>(picture->first_frame, chunk.frame);
  picture->last_frame = std::max<std::uint64_t>(picture->last_frame, chunk.frame);
}

const ChunkPicture* ChunkPictures::last_complete(omma_ImageKind kind) const {
  for (auto at = pictures_.rbegin(); at != pictures_.rend(); ++at)
    if (at->second.kind == kind && at->second.complete()) return &at->second;
  return nullptr;
}

}  // namespace omma::ground
