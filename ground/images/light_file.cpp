#include "ground/images/light_file.hpp"

#include <vector>

#include "components/sensor/fits_handle.hpp"

namespace omma::ground {

void write_light(const std::filesystem::path& file, const ChunkPicture& picture) {
  std::vector<float> light;
  light.reserve(picture.levels.size());
  for (const std::uint16_t level : picture.levels)
    light.push_back(static_cast<float>(picture.scale.light(level)));
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  FitsFile fits(file.string());
  fits.create();
  std::array<long, 2> sides{picture.picture.width, picture.picture.height};
  std::array<long, 2> first{1, 1};
  std::string order = "TOP-DOWN";
  std::string unit = picture.composite == omma_COMPOSITE_FUSED ? "white/s" : "white";
  const char* expected = "a file that can be written";
  fits.call([&](int* status) { fits_create_img(fits.get(), FLOAT_IMG, 2, sides.data(), status); }, expected);
  fits.call(
      [&](int* status) {
        fits_write_key(fits.get(), TSTRING, "ROWORDER", order.data(), "first row is the top one", status);
        fits_write_key(fits.get(), TSTRING, "BUNIT", unit.data(), "shares of the cameras' white level",
                       status);
        fits_write_pix(fits.get(), TFLOAT, first.data(), static_cast<LONGLONG>(light.size()), light.data(),
                       status);
      },
      expected);
  fits.close();
}

}  // namespace omma::ground
