#include "ground/solve/solve_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "components/catalogue/solar_system.hpp"
#include "components/catalogue/star_names.hpp"
#include "ground/annotate.hpp"
#include "ground/format.hpp"

namespace omma::ground {
namespace {

constexpr double kDegrees = 180.0 / M_PI;
constexpr double kArcseconds = 3600.0 * kDegrees;

Eigen::Vector3d sigma_arcsec(const AttitudeSolution& attitude) {
  return kArcseconds * attitude.covariance.diagonal().cwiseSqrt();
}

}  // namespace

std::string solution_text(const Rig& rig, const PhotographSolution& solution, const DotLists& dots) {
  std::string text;
  if (!solution.solved) {
    text = "no solution: " + solution.reason + "\n";
    for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
      text += format("%-10s %zu dots\n", rig.cameras[c].name.c_str(), dots.cameras[c].dots.size());
    }
    return text;
  }
  const Eigen::Quaterniond& q = solution.attitude.rig_from_j2000;
  const Eigen::Vector3d sigma = sigma_arcsec(solution.attitude);
  text += "camera           RA        Dec       roll   stars  dots\n";
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const SolvedCamera& camera = solution.cameras[c];
    text += format("%-10s %9.4f° %+9.4f° %9.4f°  %5d %5zu\n", rig.cameras[c].name.c_str(),
                   camera.right_ascension * kDegrees, camera.declination * kDegrees, camera.roll * kDegrees,
                   camera.stars_used, dots.cameras[c].dots.size());
  }
  text += format("rig_from_j2000   x %+.9f  y %+.9f  z %+.9f  w %+.9f\n", q.x(), q.y(), q.z(), q.w());
  text +=
      format("1-sigma          x %.2f\"  y %.2f\"  z %.2f\" (rig axes)\n", sigma.x(), sigma.y(), sigma.z());
  text += format("stars used       %d, residual rms %.3f px, false match below 1e%.0f\n", solution.stars_used,
                 solution.residual_rms_px, solution.log10_false_match);
  if (solution.away_from_hint) text += "hint             wrong: found elsewhere than --near says\n";
  for (const SolvedPair& pair : solution.solar) {
    const Dot& dot = dots.cameras[pair.pairing.camera].dots[pair.pairing.dot];
    text +=
        format("%-16s %s (%.1f, %.1f), %.2f px from its place\n",
               std::string(solar_body_name(pair.pairing.entry)).c_str(),
               rig.cameras[pair.pairing.camera].name.c_str(), dot.pixel.x(), dot.pixel.y(), pair.residual_px);
  }
  text += format("time             extract %.2f ms, identify %.2f ms, attitude %.2f ms\n",
                 solution.times.extract_ms, solution.times.identify_ms, solution.times.attitude_ms);
  return text;
}

std::string solution_json(const Rig& rig, const PhotographSolution& solution, const DotLists& dots) {
  nlohmann::ordered_json json;
  json["solved"] = solution.solved;
  json["reason"] = solution.reason;
  if (solution.solved) {
    const Eigen::Quaterniond& q = solution.attitude.rig_from_j2000;
    const Eigen::Vector3d sigma = sigma_arcsec(solution.attitude);
    json["rig_from_j2000"] = {q.x(), q.y(), q.z(), q.w()};
    json["sigma_arcsec"] = {sigma.x(), sigma.y(), sigma.z()};
  } else {
    json["rig_from_j2000"] = nullptr;
    json["sigma_arcsec"] = nullptr;
  }
  json["stars_used"] = solution.stars_used;
  json["residual_rms_px"] = solution.residual_rms_px;
  json["away_from_hint"] = solution.away_from_hint;
  json["cameras"] = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    nlohmann::ordered_json camera;
    camera["name"] = std::string(rig.cameras[c].name.view());
    if (solution.solved) {
      camera["ra_deg"] = solution.cameras[c].right_ascension * kDegrees;
      camera["dec_deg"] = solution.cameras[c].declination * kDegrees;
      camera["roll_deg"] = solution.cameras[c].roll * kDegrees;
      camera["stars_used"] = solution.cameras[c].stars_used;
    } else {
      camera["ra_deg"] = camera["dec_deg"] = camera["roll_deg"] = nullptr;
      camera["stars_used"] = 0;
    }
    camera["dots"] = dots.cameras[c].dots.size();
    json["cameras"].push_back(camera);
  }
  json["solar_system"] = nlohmann::ordered_json::array();
  for (const SolvedPair& pair : solution.solar) {
    const Dot& dot = dots.cameras[pair.pairing.camera].dots[pair.pairing.dot];
    json["solar_system"].push_back({{"name", solar_body_name(pair.pairing.entry)},
                                    {"camera", std::string(rig.cameras[pair.pairing.camera].name.view())},
                                    {"u_px", dot.pixel.x()},
                                    {"v_px", dot.pixel.y()},
                                    {"offset_px", pair.residual_px}});
  }
  json["time_ms"] = {{"extract", solution.times.extract_ms},
                     {"identify", solution.times.identify_ms},
                     {"attitude", solution.times.attitude_ms}};
  return json.dump() + "\n";
}

void write_annotated(const std::string& file, const ImageView& image, const Rig& rig, std::size_t camera,
                     const PhotographSolution& solution, const DotLists& dots) {
  Annotation annotation;
  const DotList& list = dots.cameras[camera];
  std::vector<Mark> marks(list.dots.size());
  for (std::size_t d = 0; d < marks.size(); ++d) marks[d].pixel = list.dots[d].pixel;
  for (const SolvedPair& pair : solution.pairs) {
    if (pair.pairing.camera != camera) continue;
    Mark& mark = marks[pair.pairing.dot];
    mark.kind = pair.used ? MarkKind::kPaired : MarkKind::kCulled;
    mark.label = star_label(pair.pairing.entry).view();
  }
  for (const SolvedPair& pair : solution.solar) {
    if (pair.pairing.camera != camera) continue;
    Mark& mark = marks[pair.pairing.dot];
    mark.kind = MarkKind::kSolar;
    mark.label = solar_body_name(pair.pairing.entry);
  }
  annotation.marks = std::move(marks);
  annotation.title = std::string(rig.cameras[camera].name.view());
  if (solution.solved) {
    const SolvedCamera& solved = solution.cameras[camera];
    annotation.lines.push_back(format("RA %.3f°  Dec %+.3f°  roll %.3f°", solved.right_ascension * kDegrees,
                                      solved.declination * kDegrees, solved.roll * kDegrees));
    annotation.lines.push_back(format("%d stars used of %zu dots, residual %.3f px rms", solved.stars_used,
                                      list.dots.size(), solution.residual_rms_px));
    annotation.sky =
        SkyView{rig.cameras[camera].lens,
                rig.cameras[camera].rig_from_camera.rotation.conjugate() * solution.attitude.rig_from_j2000};
  } else {
    annotation.lines.push_back("no solution: " + solution.reason);
  }
  annotate(image, annotation).write_png(file);
}

}  // namespace omma::ground
