// The light of a picture as numbers, for who measures it.
#pragma once

#include <filesystem>

#include "ground/report/chunk_pictures.hpp"

namespace omma::ground {

/// FITS, 32-bit numbers, the top row first (ROWORDER): light in the unit of the picture's scale; what was not
/// seen or did not come down is not a number. @throws InputError: a place that cannot be written
void write_light(const std::filesystem::path& file, const ChunkPicture& picture);

}  // namespace omma::ground
