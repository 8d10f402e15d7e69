#include "ground/resect/resect_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "components/geometry/angles.hpp"
#include "ground/annotate.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

using nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kMillimetres = 1e3;

ordered_json three(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

ordered_json pose_json(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {{"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}, {"translation_m", three(pose.translation)}};
}

std::string pose_text(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& t = pose.translation;
  const YawPitchRoll angles = yaw_pitch_roll(q);
  return format("position         x %+.5f  y %+.5f  z %+.5f m\n", t.x(), t.y(), t.z()) +
         format("rotation         x %+.9f  y %+.9f  z %+.9f  w %+.9f\n", q.x(), q.y(), q.z(), q.w()) +
         format("                 yaw %+.4f°  pitch %+.4f°  roll %+.4f°\n", angles.yaw * kDegrees,
                angles.pitch * kDegrees, angles.roll * kDegrees);
}

const char* doubt(const PoseSolution& pose) {
  if (pose.ambiguous) return "ambiguous: a second pose fits the dots as well";
  return pose.has_alternative ? "a second pose fits the dots worse" : "";
}

}  // namespace

std::string resection_text(const Rig& rig, const Resection& resection, const DotLists& dots) {
  std::string text;
  if (!resection.solved) text = "no solution: " + resection.reason + "\n";
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    text += format("%-16s %d targets used of %zu dots\n", rig.cameras[c].name.c_str(),
                   resection.solved ? resection.targets_used[c] : 0, dots.cameras[c].dots.size());
  }
  if (!resection.solved) return text;
  const Vector6d sigma = resection.pose.covariance.diagonal().cwiseSqrt();
  text += "rig_from_body\n" + pose_text(resection.pose.rig_from_body);
  text += format("1-sigma          x %.3f  y %.3f  z %.3f mm\n", sigma(3) * kMillimetres,
                 sigma(4) * kMillimetres, sigma(5) * kMillimetres);
  text += format("                 x %.4f°  y %.4f°  z %.4f° (rig axes)\n", sigma(0) * kDegrees,
                 sigma(1) * kDegrees, sigma(2) * kDegrees);
  text += format("range            %.5f m, 1-sigma %.3f mm, to the middle of the targets\n", resection.range,
                 resection.range_sigma * kMillimetres);
  text += format("residual rms     %.3f px; lens error taken as %.3f px; ", resection.residual_rms_px,
                 resection.lens_error_px);
  text += resection.by_hand ? std::string("begun from pairs picked by hand\n")
                            : format("chance match 1e%.0f\n", resection.log10_chance_match);
  const Pose body_from_rig = resection.pose.rig_from_body.inverse();
  text += "body_from_rig\n" + pose_text(body_from_rig);
  if (resection.pose.has_alternative) {
    text +=
        format("%s (chi2 %.1f against %.1f, probability %.2g)\n", doubt(resection.pose),
               resection.pose.alternative_chi2, resection.pose.chi2, resection.pose.alternative_probability);
    text += pose_text(resection.pose.alternative);
  } else if (resection.pose.ambiguous) {
    text += "ambiguous: the rotation of a card seen from the front hardly shows\n";
  }
  return text;
}

std::string resection_json(const Rig& rig, const Resection& resection, const DotLists& dots) {
  ordered_json json;
  json["solved"] = resection.solved;
  json["reason"] = resection.reason;
  int used = 0;
  if (resection.solved) {
    const Vector6d sigma = resection.pose.covariance.diagonal().cwiseSqrt();
    json["rig_from_body"] = pose_json(resection.pose.rig_from_body);
    json["body_from_rig"] = pose_json(resection.pose.rig_from_body.inverse());
    json["by_hand"] = resection.by_hand;
    json["sigma_deg"] = three(sigma.head<3>() * kDegrees);
    json["sigma_m"] = three(sigma.tail<3>());
    json["range_m"] = resection.range;
    json["range_sigma_m"] = resection.range_sigma;
    json["ambiguous"] = resection.pose.ambiguous;
    json["alternative"] =
        resection.pose.has_alternative ? pose_json(resection.pose.alternative) : ordered_json(nullptr);
    json["alternative_probability"] = resection.pose.alternative_probability;
    for (const int count : resection.targets_used) used += count;
  } else {
    for (const char* field : {"rig_from_body", "body_from_rig", "by_hand", "sigma_deg", "sigma_m", "range_m",
                              "range_sigma_m", "ambiguous", "alternative", "alternative_probability"}) {
      json[field] = nullptr;
    }
  }
  json["targets_used"] = used;
  json["residual_rms_px"] = resection.residual_rms_px;
  json["lens_error_px"] = resection.lens_error_px;
  json["cameras"] = ordered_json::array();
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    json["cameras"].push_back({{"name", std::string(rig.cameras[c].name.view())},
                               {"targets_used", resection.solved ? resection.targets_used[c] : 0},
                               {"dots", dots.cameras[c].dots.size()}});
  }
  return json.dump() + "\n";
}

void write_annotated(const std::string& file, const ImageView& image, const Rig& rig, std::size_t camera,
                     const TargetBody& body, const Resection& resection, const DotLists& dots) {
  Annotation annotation;
  const DotList& list = dots.cameras[camera];
  annotation.marks.resize(list.dots.size());
  for (std::size_t d = 0; d < list.dots.size(); ++d) annotation.marks[d].pixel = list.dots[d].pixel;
  for (const SolvedPair& pair : resection.pairs) {
    if (pair.pairing.camera != camera) continue;
    Mark& mark = annotation.marks[pair.pairing.dot];
    mark.kind = pair.used ? MarkKind::kPaired : MarkKind::kCulled;
    mark.label = body.targets[pair.pairing.entry].id.view();
  }
  annotation.title = std::string(rig.cameras[camera].name.view());
  if (resection.solved) {
    annotation.lines.push_back(
        format("range %.4f m, 1-sigma %.2f mm", resection.range, resection.range_sigma * kMillimetres));
    annotation.lines.push_back(format("%d targets used of %zu dots, residual %.3f px rms",
                                      resection.targets_used[camera], list.dots.size(),
                                      resection.residual_rms_px));
  } else {
    annotation.lines.push_back("no solution: " + resection.reason);
  }
  annotate(image, annotation).write_png(file);
}

}  // namespace omma::ground
