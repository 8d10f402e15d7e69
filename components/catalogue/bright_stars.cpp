// The compiled-in Bright Star Catalogue: rows as printed in the catalogue (145 kB, with a CRC-32), unpacked
// once into static storage. The table is made by ground/catalogue/generate_bright_stars.py.
#include <array>
#include <numbers>

#include "components/catalogue/star.hpp"

namespace omma {
namespace {

/// One row in the units of the printed catalogue.
struct BrightStarRow {
  std::uint16_t hr;
  std::int16_t magnitude;        // [0.01 mag]
  std::int32_t right_ascension;  // [0.1 s of time]
  std::int32_t declination;      // ["]
  std::int16_t pm_ra_cosdec;     // [0.001"/yr]
  std::int16_t pm_dec;           // [0.001"/yr]
};

constexpr BrightStarRow kRows[] = {
#define BRIGHT_STAR(hr, magnitude, ra, dec, pm_ra, pm_dec) {hr, magnitude, ra, dec, pm_ra, pm_dec},
#define BRIGHT_STAR_CHECKSUM(crc)
#include "components/catalogue/bright_stars_table.inc"
#undef BRIGHT_STAR
#undef BRIGHT_STAR_CHECKSUM
};
constexpr std::size_t kStars = std::size(kRows);

constexpr std::uint32_t kChecksum =
#define BRIGHT_STAR(hr, magnitude, ra, dec, pm_ra, pm_dec)
#define BRIGHT_STAR_CHECKSUM(crc) crc
#include "components/catalogue/bright_stars_table.inc"
#undef BRIGHT_STAR
#undef BRIGHT_STAR_CHECKSUM
    ;

/// CRC-32 (ISO 3309, reflected, polynomial 0xEDB88320) of the `bytes` lowest bytes of `value`, continued.
constexpr std::uint32_t crc32_continue(std::uint32_t crc, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    crc ^= (value >> (8 * i)) & 0xFFu;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return crc;
}

std::array<CatalogueStar, kStars> unpacked() noexcept {
  constexpr double kTurn = 2 * std::numbers::pi;
  constexpr double kSecond = kTurn / 864000;      // 0.1 s of time
  constexpr double kArcsecond = kTurn / 1296000;  // 1"
  constexpr double kMilliarcsecond = kArcsecond / 1000;
  std::array<CatalogueStar, kStars> stars;
  for (std::size_t i = 0; i < kStars; ++i) {
    const BrightStarRow& row = kRows[i];
    stars[i] = {row.hr,
                static_cast<float>(row.magnitude) / 100.0F,
                row.right_ascension * kSecond,
                row.declination * kArcsecond,
                static_cast<float>(row.pm_ra_cosdec * kMilliarcsecond),
                static_cast<float>(row.pm_dec * kMilliarcsecond)};
  }
  return stars;
}

}  // namespace

std::span<const CatalogueStar> bright_star_catalogue() noexcept {
  static const std::array<CatalogueStar, kStars> stars = unpacked();
  return stars;
}

bool bright_star_catalogue_intact() noexcept {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const BrightStarRow& row : kRows) {
    crc = crc32_continue(crc, row.hr, 2);
    crc = crc32_continue(crc, static_cast<std::uint16_t>(row.magnitude), 2);
    crc = crc32_continue(crc, static_cast<std::uint32_t>(row.right_ascension), 4);
    crc = crc32_continue(crc, static_cast<std::uint32_t>(row.declination), 4);
    crc = crc32_continue(crc, static_cast<std::uint16_t>(row.pm_ra_cosdec), 2);
    crc = crc32_continue(crc, static_cast<std::uint16_t>(row.pm_dec), 2);
  }
  return (crc ^ 0xFFFFFFFFu) == kChecksum;
}

}  // namespace omma
