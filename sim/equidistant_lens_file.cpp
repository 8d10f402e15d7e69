#include "sim/equidistant_lens_file.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace omma::sim {
namespace {

constexpr int kEvenTerms = 7;  // ρ⁰, ρ², … ρ¹²
constexpr int kSamples = 2000;
// Outside the field no light falls, but the polynomial must not turn round there: it is held loosely.
constexpr double kWeightOutside = 1e-3;

double exact_depth(double rho, double focal) {
  return rho < 1e-9 ? -focal : -rho / std::tan(rho / focal);
}

double fitted_depth(const Eigen::Matrix<double, kEvenTerms, 1>& a, double x2) {
  double value = 0;
  for (int k = kEvenTerms - 1; k >= 0; --k) value = value * x2 + a[k];
  return value;
}

}  // namespace

OcamText equidistant_as_ocam(const EquidistantLens& lens) {
  const double corner = std::hypot(std::max(lens.centre.x(), lens.width - 1 - lens.centre.x()),
                                   std::max(lens.centre.y(), lens.height - 1 - lens.centre.y()));
  const double rho_field = std::min(0.5 * lens.field * lens.focal, corner);
  // cot is singular at θ = π, where no lens looks.
  const double rho_end = std::min(corner, 0.85 * std::numbers::pi * lens.focal);

  Eigen::MatrixXd design(kSamples, kEvenTerms);
  Eigen::VectorXd depth(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double rho = rho_end * (i + 0.5) / kSamples;
    const double z = exact_depth(rho, lens.focal);
    // dr = f dθ = f ρ dz / (ρ² + z²): the error in pixels that an error of P makes.
    double weight = lens.focal * rho / (rho * rho + z * z);
    if (rho > rho_field) weight *= kWeightOutside;
    double power = weight;
    for (int k = 0; k < kEvenTerms; ++k) {
      design(i, k) = power;
      power *= (rho / rho_end) * (rho / rho_end);
    }
    depth[i] = weight * z;
  }
  const Eigen::Matrix<double, kEvenTerms, 1> a = design.colPivHouseholderQr().solve(depth);

  OcamText out;
  for (int i = 0; i < kSamples; ++i) {
    const double rho = rho_field * (i + 0.5) / kSamples;
    const double theta = std::atan2(rho, -fitted_depth(a, (rho / rho_end) * (rho / rho_end)));
    out.worst_px = std::max(out.worst_px, std::abs(lens.focal * theta - rho));
  }

  char line[64];
  auto append = [&](const char* format, auto... values) {
    std::snprintf(line, sizeof line, format, values...);
    out.text += line;
  };
  out.text = "#polynomial coefficients for the DIRECT mapping function (increasing powers of rho)\n\n";
  append("%d", 2 * kEvenTerms - 1);
  double scale = 1;
  for (int k = 0; k < kEvenTerms; ++k) {
    if (k > 0) append(" %.12e", 0.0);
    append(" %.12e", a[k] * scale);
    scale /= rho_end * rho_end;
  }
  out.text +=
      "\n\n#polynomial coefficients for the INVERSE mapping function (increasing powers of theta)\n\n";
  append("2 %.12f %.12f", 0.5 * std::numbers::pi * lens.focal, lens.focal);
  out.text += "\n\n#center: \"row\" and \"column\", starting from 0\n\n";
  append("%.6f %.6f", lens.centre.y(), lens.centre.x());
  out.text += "\n\n#affine parameters \"c\", \"d\", \"e\"\n\n1.000000 0.000000 0.000000\n\n";
  out.text += "#image size: \"height\" and \"width\"\n\n";
  append("%d %d\n", lens.height, lens.width);
  return out;
}

}  // namespace omma::sim
