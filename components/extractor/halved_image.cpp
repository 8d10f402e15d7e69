#include "components/extractor/halved_image.hpp"

#include <algorithm>
#include <cstddef>

#include "components/extractor/clones.hpp"

namespace omma {
namespace {

constexpr int kFull = 65535;

OMMA_CLONES void halve(const std::uint8_t* above, const std::uint8_t* below, int n, std::uint16_t* out) {
  for (int i = 0; i < n; ++i, above += 2, below += 2)
    out[i] = static_cast<std::uint16_t>(above[0] + above[1] + below[0] + below[1]);
}
OMMA_CLONES void halve(const std::uint16_t* above, const std::uint16_t* below, int n, std::uint16_t* out) {
  for (int i = 0; i < n; ++i, above += 2, below += 2)
    out[i] = static_cast<std::uint16_t>(std::min(above[0] + above[1] + below[0] + below[1], kFull));
}

}  // namespace

HalvedImage::HalvedImage(int width, int height) {
  pixels_.resize(static_cast<std::size_t>(std::max(1, width / 2)) *
                 static_cast<std::size_t>(std::max(1, height / 2)));
}

ImageView HalvedImage::build(const ImageView& image) noexcept {
  ImageView half;
  half.width = image.width / 2;
  half.height = image.height / 2;
  half.stride = std::ptrdiff_t{half.width} * 2;
  half.format = PixelFormat::kGrey16;
  half.white_level = static_cast<std::uint16_t>(std::min(4 * image.white_level, kFull));
  half.data = reinterpret_cast<const std::byte*>(pixels_.data());
  for (int v = 0; v < half.height; ++v) {
    std::uint16_t* out = &pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(half.width)];
    if (image.format == PixelFormat::kGrey8) {
      halve(image.row<std::uint8_t>(2 * v), image.row<std::uint8_t>(2 * v + 1), half.width, out);
    } else {
      halve(image.row<std::uint16_t>(2 * v), image.row<std::uint16_t>(2 * v + 1), half.width, out);
    }
  }
  return half;
}

void HalvedImage::enlarge(const BackgroundMap& background, Candidate& candidate) noexcept {
  for (int* side : {&candidate.left, &candidate.top}) *side *= 2;
  for (int* side : {&candidate.right, &candidate.bottom}) *side = 2 * *side + 1;
  candidate.area *= 4;
  for (float* place : {&candidate.u, &candidate.v, &candidate.top_u, &candidate.top_v})
    *place = 2 * *place + 0.5F;
  for (float* lean : {&candidate.lean_u, &candidate.lean_v}) *lean *= 0.5F;  // tanh(δ / s²), small
  candidate.peak *= 0.25F;
  candidate.height *= 0.25F;
  candidate.threshold *= 0.5F;
  const float gain = candidate.noise.gain;
  candidate.noise = {background.level(candidate.u, candidate.v), background.noise(candidate.u, candidate.v),
                     gain};
}

}  // namespace omma
