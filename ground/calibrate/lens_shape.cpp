#include "ground/calibrate/lens_shape.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr int kRadii = 200;
constexpr int kInversePowers = 15;

double half_side(int width, int height) {
  return 0.5 * std::min(width, height);
}

std::optional<Lens> kannala_brandt(const LensShape& shape) {
  const Eigen::VectorXd& p = shape.parameters;
  // KannalaBrandtModel: r = θ + k1 θ³ + k2 θ⁵ + k3 θ⁷ + k4 θ⁹.
  return Lens::kannala_brandt(shape.width, shape.height, {p[2], p[2] * p[3]}, {p[0], p[1]},
                              {p[4], p[5], p[6], p[7]}, shape.max_angle);
}

std::optional<Lens> ocam(const LensShape& shape) {
  const Eigen::VectorXd& p = shape.parameters;
  const double radius = half_side(shape.width, shape.height);
  std::vector<double> polynomial(2 * kEvenPowers - 1, 0.0);
  double scale = radius;
  for (std::size_t k = 0; k < kEvenPowers; ++k) {
    polynomial[2 * k] = p[4 + static_cast<Eigen::Index>(k)] * scale;
    scale /= radius * radius;
  }
  Eigen::Matrix2d affine;
  affine << 1, p[3], p[3], p[2];
  return Lens::ocam(shape.width, shape.height, {p[0], p[1]}, affine, polynomial);
}

std::optional<Lens> caltech(const LensShape& shape) {
  const Eigen::VectorXd& p = shape.parameters;
  return Lens::caltech(shape.width, shape.height, {p[2], p[2] * p[3]}, {p[0], p[1]}, p[4],
                       {p[5], p[6], p[7], p[8], p[9]});
}

// Radius on the model's plane against angle off axis, as the lens has it.
std::vector<Eigen::Vector2d> radius_over_angle(const Lens& lens, double max_angle) {
  std::vector<Eigen::Vector2d> pairs;
  const double end = std::min(max_angle, lens.max_angle());
  const Eigen::Matrix2d to_plane = lens.affine().inverse();
  for (int k = 1; k <= kRadii; ++k) {
    const double angle = end * k / kRadii;
    // The four ways out; a sensor may not reach the angle in all of them.
    for (const Eigen::Vector2d& out :
         {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
      Eigen::Vector2d pixel;
      const Eigen::Vector3d ray(std::sin(angle) * out.x(), std::sin(angle) * out.y(), std::cos(angle));
      if (lens.project(ray, pixel)) pairs.emplace_back(angle, (to_plane * (pixel - lens.centre())).norm());
    }
  }
  return pairs;
}

// Plane points of the lens in pixels: its affine part carries the focal length for all but OCamCalib.
double plane_scale(const Lens& lens) {
  return lens.model() == LensModel::kOcam ? 1.0 : lens.affine()(0, 0);
}

// r = f (θ + k1 θ³ + …): linear in f, f k1, ….
Eigen::Matrix<double, 5, 1> odd_powers(const std::vector<Eigen::Vector2d>& pairs, double scale) {
  Eigen::MatrixXd design(pairs.size(), 5);
  Eigen::VectorXd radius(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    double power = pairs[i].x();
    for (int k = 0; k < 5; ++k) {
      design(static_cast<Eigen::Index>(i), k) = power;
      power *= pairs[i].x() * pairs[i].x();
    }
    radius[static_cast<Eigen::Index>(i)] = scale * pairs[i].y();
  }
  return design.colPivHouseholderQr().solve(radius);
}

// F(ρ) = ρ / tan θ in even powers of ρ/R, weighted so that its error counts in pixels: dρ = ρ dF · (dθ/dF)…
Eigen::Matrix<double, kEvenPowers, 1> even_powers(const std::vector<Eigen::Vector2d>& pairs, double scale,
                                                  double half) {
  Eigen::MatrixXd design(pairs.size(), kEvenPowers);
  Eigen::VectorXd depth(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double rho = scale * pairs[i].y() / half;
    const double f = rho / std::tan(pairs[i].x());
    const double weight = rho / (rho * rho + f * f);  // dθ = −ρ dF / (ρ² + F²)
    double power = weight;
    for (int k = 0; k < kEvenPowers; ++k) {
      design(static_cast<Eigen::Index>(i), k) = power;
      power *= rho * rho;
    }
    depth[static_cast<Eigen::Index>(i)] = weight * f;
  }
  return design.colPivHouseholderQr().solve(depth);
}

std::string ocam_text(const Lens& lens) {
  const OcamModel& model = *lens.ocam_model();
  std::string text =
      "#polynomial coefficients for the DIRECT mapping function (increasing powers of rho)\n\n";
  text += format("%zu", model.polynomial().size());
  for (const double a : model.polynomial()) text += format(" %.15e", -a);
  // ρ over the angle from the image plane, atan(−F/ρ), by least squares: readers of other programs use it.
  const double end = std::min(model.max_angle(), 3.0);
  Eigen::MatrixXd design(kRadii, kInversePowers);
  Eigen::VectorXd radius(kRadii);
  for (int i = 0; i < kRadii; ++i) {
    const double angle = end * (i + 0.5) / kRadii;
    Eigen::Vector2d plane;
    model.plane_from_ray({std::sin(angle), 0, std::cos(angle)}, plane, nullptr);
    const double from_plane = angle - 0.5 * M_PI;
    for (int k = 0; k < kInversePowers; ++k) design(i, k) = std::pow(from_plane, k);
    radius[i] = plane.x();
  }
  const Eigen::VectorXd inverse = design.colPivHouseholderQr().solve(radius);
  text += "\n\n#polynomial coefficients for the INVERSE mapping function (increasing powers of theta)\n\n";
  text += format("%d", kInversePowers);
  for (const double b : inverse) text += format(" %.12e", b);
  const Eigen::Matrix2d a = lens.affine();
  text += format("\n\n#center: \"row\" and \"column\", starting from 0\n\n%.9f %.9f", lens.centre().y(),
                 lens.centre().x());
  text +=
      format("\n\n#affine parameters \"c\", \"d\", \"e\"\n\n%.12f %.12f %.12f", a(1, 1), a(1, 0), a(0, 1));
  return text + format("\n\n#image size: \"height\" and \"width\"\n\n%d %d\n", lens.height(), lens.width());
}

std::string bouguet_text(const Lens& lens) {
  const auto& k = lens.caltech_model()->coefficients();
  const Eigen::Matrix2d a = lens.affine();
  return format("fc = [ %.12f ; %.12f ];\ncc = [ %.9f ; %.9f ];\n", a(0, 0), a(1, 1), lens.centre().x(),
                lens.centre().y()) +
         format("alpha_c = %.15e;\nkc = [ %.15e ; %.15e ; %.15e ; %.15e ; %.15e ];\n", a(0, 1) / a(0, 0),
                k[0], k[1], k[2], k[3], k[4]) +
         format("nx = %d;\nny = %d;\n", lens.width(), lens.height());
}

std::string kalibr_text(const Lens& lens) {
  const auto& k = lens.kannala_brandt_model()->coefficients();
  return "cam0:\n  camera_model: pinhole\n  distortion_model: equidistant\n" +
         format("  intrinsics: [%.12f, %.12f, %.9f, %.9f]\n", lens.affine()(0, 0), lens.affine()(1, 1),
                lens.centre().x(), lens.centre().y()) +
         format("  distortion_coeffs: [%.15e, %.15e, %.15e, %.15e]\n", k[0], k[1], k[2], k[3]) +
         format("  resolution: [%d, %d]\n", lens.width(), lens.height());
}

}  // namespace

std::optional<Lens> LensShape::lens() const {
  try {
    if (model == LensModel::kCaltech) return caltech(*this);
    return model == LensModel::kOcam ? ocam(*this) : kannala_brandt(*this);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::vector<std::string> LensShape::names() const {
  if (model == LensModel::kKannalaBrandt)
    return {"centre_u", "centre_v", "f", "aspect", "k1", "k2", "k3", "k4"};
  if (model == LensModel::kCaltech)
    return {"centre_u", "centre_v", "f", "aspect", "skew", "k1", "k2", "p1", "p2", "k3"};
  std::vector<std::string> all{"centre_u", "centre_v", "aspect", "skew"};
  for (int k = 0; k < kEvenPowers; ++k) all.push_back(format("a%d", 2 * k));
  return all;
}

Eigen::VectorXd LensShape::steps() const {
  Eigen::VectorXd step = Eigen::VectorXd::Constant(parameters.size(), 1e-6);
  step[0] = step[1] = 1e-3;
  if (model != LensModel::kOcam) step[2] = 1e-3;
  return step;
}

LensShape equidistant_shape(int width, int height, double focal, double max_angle) {
  LensShape shape{LensModel::kKannalaBrandt, width, height, max_angle, Eigen::VectorXd::Zero(8)};
  shape.parameters.head<4>() << 0.5 * (width - 1), 0.5 * (height - 1), focal, 1.0;
  return shape;
}

LensShape nearest_shape(const Lens& lens, LensModel model, double max_angle) {
  LensShape shape{model, lens.width(), lens.height(), max_angle, {}};
  if (model == LensModel::kCaltech) {
    // A pinhole of the focal length on the axis: its distortion is for the adjustment to find.
    const double focal = 1 / lens.pixel_angle();
    shape.parameters = Eigen::VectorXd::Zero(10);
    shape.parameters.head<4>() << lens.centre(), focal, 1.0;
    return shape;
  }
  const std::vector<Eigen::Vector2d> pairs = radius_over_angle(lens, max_angle);
  const double scale = plane_scale(lens);
  const Eigen::Matrix2d affine = lens.affine() / scale;
  if (model == LensModel::kKannalaBrandt) {
    const Eigen::Matrix<double, 5, 1> odd = odd_powers(pairs, scale);
    shape.parameters.resize(8);
    shape.parameters << lens.centre(), odd[0], affine(1, 1), odd.tail<4>() / odd[0];
  } else {
    const double half = half_side(lens.width(), lens.height());
    shape.parameters.resize(4 + kEvenPowers);
    shape.parameters << lens.centre(), affine(1, 1), 0.5 * (affine(0, 1) + affine(1, 0)),
        even_powers(pairs, scale, half);
  }
  return shape;
}

std::string lens_file_text(const Lens& lens) {
  if (lens.model() == LensModel::kOcam) return ocam_text(lens);
  if (lens.model() == LensModel::kKannalaBrandt) return kalibr_text(lens);
  return bouguet_text(lens);
}

}  // namespace omma::ground
