#include "ground/calibrate/sky_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kBright = 4.5;  // V; dots of fainter stars are noise more than lens

struct CameraFigures {
  int stars = 0;
  double rms = 0;         // root mean square length of the residuals [px]
  int bright = 0;         // stars to V 4.5
  double bright_rms = 0;  // [px]
  double widest = 0;      // largest angle off axis of a star used [rad]
};

double angle_of(const SkyCalibration& c, const StarSight& sight) {
  Eigen::Vector3d ray;
  c.rig.cameras[static_cast<std::size_t>(sight.camera)].lens.bearing(sight.pixel, ray);
  return std::atan2(ray.head<2>().norm(), ray.z());
}

CameraFigures figures_of(const SkyCalibration& c, std::size_t camera) {
  CameraFigures f;
  double sum = 0;
  double bright_sum = 0;
  for (std::size_t i = 0; i < c.sights.size(); ++i) {
    if (c.adjustment.used[i] == 0 || c.sights[i].camera != static_cast<int>(camera)) continue;
    const double squared = c.adjustment.residuals[i].squaredNorm();
    ++f.stars;
    sum += squared;
    f.widest = std::max(f.widest, angle_of(c, c.sights[i]));
    if (c.magnitudes[i] >= kBright) continue;
    ++f.bright;
    bright_sum += squared;
  }
  f.rms = f.stars > 0 ? std::sqrt(sum / f.stars) : 0;
  f.bright_rms = f.bright > 0 ? std::sqrt(bright_sum / f.bright) : 0;
  return f;
}

std::vector<double> told_angles(const CameraFigures& f) {
  std::vector<double> angles;
  const int steps = std::max(1, static_cast<int>(f.widest / (15 * kDegree)));
  for (int k = 0; k <= steps; ++k) angles.push_back(k == 0 ? 1 * kDegree : k * 15 * kDegree);
  return angles;
}

Eigen::MatrixXd lens_covariance(const SkyCalibration& c, std::size_t camera) {
  const auto size = c.adjustment.rig.lenses[camera].parameters.size();
  const int offset = c.adjustment.lens_offset(camera);
  return c.adjustment.covariance.block(offset, offset, size, size);
}

}  // namespace

std::string sky_report_text(const SkyCalibration& c) {
  std::string text =
      format("calibrated on %zu stars of %zu exposures in %d passes; guess's focal length times %.3f\n",
             static_cast<std::size_t>(std::count(c.adjustment.used.begin(), c.adjustment.used.end(), 1)),
             c.adjustment.rig.rig_from_j2000.size(), c.passes, c.focal_factor);
  text += format("chi2 per degree of freedom %.3f with %.3f px of error beyond the dots' own\n",
                 c.adjustment.chi2 / std::max(1, c.adjustment.degrees), c.adjustment.floor_px);
  for (std::size_t camera = 0; camera < c.rig.cameras.size(); ++camera) {
    const CameraFigures f = figures_of(c, camera);
    text += format("%-10s rms %.3f px (%d stars, to %.1f deg off axis); %.3f px (%d stars below V %.1f)\n",
                   c.rig.cameras[camera].name.c_str(), f.rms, f.stars, f.widest / kDegree, f.bright_rms,
                   f.bright, kBright);
    const LensShape& shape = c.adjustment.rig.lenses[camera];
    const Eigen::MatrixXd covariance = lens_covariance(c, camera);
    const std::vector<std::string> names = shape.names();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      text += format("  %-9s %14.7f  +- %.7f\n", names[k].c_str(), shape.parameters[i],
                     std::sqrt(covariance(i, i)));
    }
    text += "  lens known to";
    const std::vector<double> angles = told_angles(f);
    const std::vector<double> deviations = lens_deviations(shape, covariance, angles);
    for (std::size_t k = 0; k < angles.size(); ++k)
      text += format(" %.3f px at %.0f,", deviations[k], angles[k] / kDegree);
    text.back() = ' ';
    text += "deg off axis (1 sigma)\n";
  }
  return text;
}

std::string sky_report_json(const SkyCalibration& c) {
  nlohmann::ordered_json json{{"passes", c.passes},
                              {"exposures", c.adjustment.rig.rig_from_j2000.size()},
                              {"rms_px", c.adjustment.rms_px},
                              {"extra_error_px", c.adjustment.floor_px},
                              {"chi2", c.adjustment.chi2},
                              {"degrees_of_freedom", c.adjustment.degrees},
                              {"focal_factor", c.focal_factor}};
  json["cameras"] = nlohmann::ordered_json::array();
  for (std::size_t camera = 0; camera < c.rig.cameras.size(); ++camera) {
    const CameraFigures f = figures_of(c, camera);
    const LensShape& shape = c.adjustment.rig.lenses[camera];
    const Eigen::MatrixXd covariance = lens_covariance(c, camera);
    nlohmann::ordered_json one{{"name", c.rig.cameras[camera].name.view()},
                               {"stars", f.stars},
                               {"rms_px", f.rms},
                               {"stars_below_v4_5", f.bright},
                               {"rms_below_v4_5_px", f.bright_rms},
                               {"widest_deg", f.widest / kDegree}};
    one["parameters"] = nlohmann::ordered_json::object();
    const std::vector<std::string> names = shape.names();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      one["parameters"][names[k]] = {{"value", shape.parameters[i]}, {"sigma", std::sqrt(covariance(i, i))}};
    }
    one["covariance"] = nlohmann::ordered_json::array();
    for (Eigen::Index row = 0; row < covariance.rows(); ++row) {
      std::vector<double> values(covariance.row(row).begin(), covariance.row(row).end());
      one["covariance"].push_back(values);
    }
    json["cameras"].push_back(one);
  }
  json["rig_from_j2000"] = nlohmann::ordered_json::array();
  for (const Eigen::Quaterniond& q : c.adjustment.rig.rig_from_j2000)
    json["rig_from_j2000"].push_back({q.x(), q.y(), q.z(), q.w()});
  json["stars"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < c.sights.size(); ++i) {
    const StarSight& sight = c.sights[i];
    const Eigen::Vector2d& residual = c.adjustment.residuals[i];
    json["stars"].push_back({{"exposure", sight.frame},
                             {"camera", sight.camera},
                             {"hr", sight.hr},
                             {"v", c.magnitudes[i]},
                             {"pixel", {sight.pixel.x(), sight.pixel.y()}},
                             {"sigma_px", std::sqrt(0.5 * sight.covariance.trace())},
                             {"residual_px", {residual.x(), residual.y()}},
                             {"used", c.adjustment.used[i] != 0}});
  }
  return json.dump(1) + "\n";
}

std::string sky_report_page(const SkyCalibration& c) {
  std::string figures;
  std::string charts;
  for (std::size_t camera = 0; camera < c.rig.cameras.size(); ++camera) {
    const CameraFigures f = figures_of(c, camera);
    const std::string name = escaped(c.rig.cameras[camera].name.c_str());
    figures +=
        figure(format("%.3f px", f.bright_rms), format("%s: rms of %d stars below V %.1f; %.3f px of all %d",
                                                       name.c_str(), f.bright, kBright, f.rms, f.stars));
    XySeries scatter{"", "a", Mark::kPoints, {}};
    XySeries radial{"", "a", Mark::kPoints, {}};
    XySeries around{"", "b", Mark::kPoints, {}};
    const Eigen::Vector2d centre = c.rig.cameras[camera].lens.centre();
    for (std::size_t i = 0; i < c.sights.size(); ++i) {
      if (c.adjustment.used[i] == 0 || c.sights[i].camera != static_cast<int>(camera)) continue;
      const Eigen::Vector2d& r = c.adjustment.residuals[i];
      const Eigen::Vector2d out = (c.sights[i].pixel - centre).normalized();
      const double angle = angle_of(c, c.sights[i]) / kDegree;
      scatter.points.push_back(r);
      radial.points.emplace_back(angle, r.dot(out));
      around.points.emplace_back(angle, r.y() * out.x() - r.x() * out.y());
    }
    charts += xy_chart(
        {name + ": residuals", {"right [px]", false, -1, 1}, {"down [px]", false, -1, 1}, {scatter}, true});
    charts += xy_chart(
        {name + ": radial", {"off axis [&deg;]", false, 0, 0}, {"outwards [px]", false, -1, 1}, {radial}});
    charts += xy_chart({name + ": tangential",
                        {"off axis [&deg;]", false, 0, 0},
                        {"clockwise [px]", false, -1, 1},
                        {around}});
    const std::vector<double> angles = told_angles(f);
    XySeries known{"", "a", Mark::kLine, {}};
    const std::vector<double> deviations =
        lens_deviations(c.adjustment.rig.lenses[camera], lens_covariance(c, camera), angles);
    for (std::size_t k = 0; k < angles.size(); ++k)
      known.points.emplace_back(angles[k] / kDegree, deviations[k]);
    charts += xy_chart({name + ": how well the lens is known",
                        {"off axis [&deg;]", false, 0, 0},
                        {"1 &sigma; [px]", false, 0, 0},
                        {known}});
  }
  return page_head("Omma: calibration on the stars", "Calibration on the stars",
                   format("%zu exposures; %.3f px of error beyond the dots' own; &chi;&sup2; per degree of "
                          "freedom %.2f.",
                          c.adjustment.rig.rig_from_j2000.size(), c.adjustment.floor_px,
                          c.adjustment.chi2 / std::max(1, c.adjustment.degrees))) +
         figures_row(figures) + "<h2>Residuals</h2><div class='charts'>" + charts + "</div>" +
         "<p class='note'>Residual: dot minus where lens and attitude put its star. Culled dots are left "
         "out.</p>" +
         page_end();
}

}  // namespace omma::ground
