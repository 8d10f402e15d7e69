#include "sim/star_colour.hpp"

#include <algorithm>
#include <cmath>

#include "sim/faint_stars.hpp"

namespace omma::sim {
namespace {

struct Colour {
  std::uint16_t hr;
  std::int16_t hundredths;
};
constexpr Colour kColours[] = {
#define STAR_COLOUR(hr, hundredths) {hr, hundredths},
#include "sim/star_colours_table.inc"
#undef STAR_COLOUR
};

constexpr double kUsual = 0.6;  // about the Sun's, in the middle of the catalogue
constexpr double kBluest = -0.4;
constexpr double kStep = 0.01;
constexpr int kSteps = 441;  // to B − V = 4

// Share of the energy (not of the photons), by wavelength [nm].
const SpectralResponse& v_band() {
  static const SpectralResponse band{{470, 0.000}, {480, 0.030}, {490, 0.163}, {500, 0.458}, {510, 0.780},
                                     {520, 0.967}, {530, 1.000}, {540, 0.973}, {550, 0.898}, {560, 0.792},
                                     {570, 0.684}, {580, 0.574}, {590, 0.461}, {600, 0.359}, {610, 0.270},
                                     {620, 0.197}, {630, 0.135}, {640, 0.081}, {650, 0.045}, {660, 0.025},
                                     {670, 0.017}, {680, 0.013}, {690, 0.009}, {700, 0.000}};
  return band;
}

double efficiency(const SpectralResponse& response, double wavelength) {
  const auto above = std::upper_bound(response.begin(), response.end(), wavelength,
                                      [](double w, const ResponsePoint& p) { return w < p.wavelength; });
  if (above == response.begin()) return 0;
  if (above == response.end())
    return wavelength == response.back().wavelength ? response.back().efficiency : 0;
  const ResponsePoint& low = *(above - 1);
  const double part = (wavelength - low.wavelength) / (above->wavelength - low.wavelength);
  return low.efficiency + part * (above->efficiency - low.efficiency);
}

/// Photons of a black body by wavelength [nm], any scale.
double photons(double temperature, double wavelength) {
  constexpr double kSecondRadiation = 1.438776877e7;  // hc/k [nm K]
  return std::pow(wavelength / 550, -4) / std::expm1(kSecondRadiation / (wavelength * temperature));
}

/// Photons counted over those of V.
double counted(const SpectralResponse& response, double temperature) {
  double in_response = 0;
  double in_v = 0;
  for (int k = 0; k <= 380; ++k) {
    const double wavelength = 250 + 2.5 * k;  // to 1200 nm
    const double light = photons(temperature, wavelength);
    in_response += light * efficiency(response, wavelength);
    in_v += light / wavelength * efficiency(v_band(), wavelength);
  }
  return in_response / in_v;
}

}  // namespace

double star_colour(std::uint16_t hr) {
  if (hr >= kFirstFaintStar) return faint_star_colour(hr);
  const auto* found = std::lower_bound(std::begin(kColours), std::end(kColours), hr,
                                       [](const Colour& c, std::uint16_t n) { return c.hr < n; });
  return found != std::end(kColours) && found->hr == hr ? 0.01 * found->hundredths : kUsual;
}

double star_temperature(double colour) {
  const double x = 0.92 * colour;
  return 4600 * (1 / (x + 1.7) + 1 / (x + 0.62));
}

ColourFactors::ColourFactors(const SpectralResponse& response) {
  if (response.empty()) return;
  const double white = counted(response, star_temperature(0));
  for (int i = 0; i < kSteps; ++i)
    factor_.push_back(static_cast<float>(counted(response, star_temperature(kBluest + kStep * i)) / white));
}

double ColourFactors::operator()(double colour) const {
  if (factor_.empty()) return 1;
  const long step = std::lround((colour - kBluest) / kStep);
  return double{factor_[static_cast<std::size_t>(std::clamp(step, 0L, long{kSteps} - 1))]};
}

}  // namespace omma::sim
