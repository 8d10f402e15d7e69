#include "ground/design/design_study.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsec = kDegree / 3600;

double longitude_deg(const Eigen::Vector3d& v) {
  return std::atan2(v.y(), v.x()) / kDegree;
}
double latitude_deg(const Eigen::Vector3d& v) {
  return std::asin(std::clamp(v.z(), -1.0, 1.0)) / kDegree;
}

nlohmann::ordered_json field_json(const NeededField& needed) {
  return {{"field_deg", needed.field / kDegree},
          {"worst_direction", {needed.worst.x(), needed.worst.y(), needed.worst.z()}}};
}

nlohmann::ordered_json spread_json(const Spread& s, double unit) {
  return {{"mean", s.mean / unit}, {"p05", s.low / unit},     {"median", s.median / unit},
          {"p95", s.high / unit},  {"least", s.least / unit}, {"most", s.most / unit}};
}

nlohmann::ordered_json coverage_json(const Coverage& coverage) {
  nlohmann::ordered_json json{{"seen_share", coverage.seen()}, {"share_by_cameras", coverage.share}};
  json["blind_spots"] = nlohmann::ordered_json::array();
  for (const BlindSpot& spot : coverage.blind) {
    json["blind_spots"].push_back({{"longitude_deg", longitude_deg(spot.middle)},
                                   {"latitude_deg", latitude_deg(spot.middle)},
                                   {"share", spot.share}});
  }
  return json;
}

Eigen::Vector3d box_of(const Rig& rig) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  for (const RigCamera& camera : rig.cameras) {
    low = low.cwiseMin(camera.rig_from_camera.translation);
    high = high.cwiseMax(camera.rig_from_camera.translation);
  }
  return high - low;
}

std::string coverage_text(const char* where, const Coverage& coverage) {
  std::string text = format("  %-12s %6.2f %% seen", where, 100 * coverage.seen());
  for (std::size_t count = 1; count < coverage.share.size(); ++count) {
    if (coverage.share[count] > 0) text += format(", %.2f %% by %zu", 100 * coverage.share[count], count);
  }
  text += "\n";
  int told = 0;
  for (const BlindSpot& spot : coverage.blind) {
    if (++told > 6) break;
    text += format("    blind %d: %.2f %% of the sphere about longitude %.1f latitude %.1f deg\n", told,
                   100 * spot.share, longitude_deg(spot.middle), latitude_deg(spot.middle));
  }
  return text;
}

}  // namespace

DesignStudy study(const PaperRig& paper, const StudyOptions& options, const TargetBody* body) {
  DesignStudy s;
  s.paper = paper;
  s.options = options;
  const std::vector<CameraPlace> places = places_of(paper.rig);
  s.needed = needed_field(places, options.distance);
  s.needed_infinity = needed_field(places, kInfinitelyFar);
  s.near = coverage_of(paper, options.distance);
  s.infinity = coverage_of(paper, kInfinitelyFar);
  s.whole_sky_beyond = whole_sky_beyond(paper);
  s.sky = expected_sky(paper, options.magnitude, options.dot_sigma);
  s.box = box_of(paper.rig);
  if (body != nullptr) {
    s.body = body->name.view();
    s.poses = expected_pose(paper, *body, options.range, options.dot_sigma);
  }
  return s;
}

std::vector<SymmetricRow> symmetric_table(double spacing, double distance) {
  std::vector<SymmetricRow> rows;
  for (int cameras = kFewestSymmetric; cameras <= kMostSymmetric; ++cameras) {
    const std::vector<CameraPlace> places = symmetric_places(cameras, spacing);
    rows.push_back({cameras, needed_field(places, distance), needed_field(places, kInfinitelyFar)});
  }
  return rows;
}

std::string symmetric_text(const std::vector<SymmetricRow>& rows, double spacing, double distance) {
  std::string text =
      format("Field of view for the whole sky beyond %g m, neighbours %g m apart\n", distance, spacing) +
      "cameras  arrangement            field [deg]  at infinity  worst direction (longitude, latitude)\n";
  for (const SymmetricRow& row : rows) {
    text += format("%7d  %-21s %12.1f %12.1f  %.1f, %.1f\n", row.cameras, symmetric_name(row.cameras),
                   row.needed.field / kDegree, row.needed_infinity.field / kDegree,
                   longitude_deg(row.needed.worst), latitude_deg(row.needed.worst));
  }
  return text;
}

std::string study_text(const DesignStudy& s) {
  std::string text =
      format("Rig %s: %zu cameras, centres within %.3f x %.3f x %.3f m\n", s.paper.rig.name.c_str(),
             s.paper.rig.cameras.size(), s.box.x(), s.box.y(), s.box.z());
  text += "camera        pixels   off axis [deg]  scale [arcsec/px]  stars mean (5 %..95 %)";
  text += s.body.empty() ? "\n" : format("  pose sigma at %g m\n", s.options.range);
  for (std::size_t c = 0; c < s.paper.rig.cameras.size(); ++c) {
    const RigCamera& camera = s.paper.rig.cameras[c];
    const Spread& stars = s.sky.stars[c];
    text += format("%-10s %4d x %-4d %12.1f %17.1f  %10.1f (%.0f..%.0f)", camera.name.c_str(),
                   camera.lens.width(), camera.lens.height(), s.paper.reach(c) / kDegree,
                   camera.lens.pixel_angle() / kArcsec, stars.mean, stars.low, stars.high);
    if (!s.body.empty() && s.poses[c]) {
      text += format("   %.2f mm, %.3f deg (%d targets)", 1e3 * s.poses[c]->position_sigma,
                     s.poses[c]->rotation_sigma / kDegree, s.poses[c]->targets);
    } else if (!s.body.empty()) {
      text += "   none";
    }
    text += "\n";
  }
  text += format(
      "Circular lenses at these places need %.1f deg for the whole sky beyond %g m, %.1f deg at infinity\n",
      s.needed.field / kDegree, s.options.distance, s.needed_infinity.field / kDegree);
  text += "Coverage\n" + coverage_text(format("at %g m", s.options.distance).c_str(), s.near) +
          coverage_text("at infinity", s.infinity);
  text += s.whole_sky_beyond ? format("  whole sky beyond %.3f m\n", *s.whole_sky_beyond)
                             : std::string("  never the whole sky\n");
  text += format("Stars to V %.2f: mean %.1f, 5 %% of attitudes below %.0f, least %.0f\n",
                 s.options.magnitude, s.sky.all_stars.mean, s.sky.all_stars.low, s.sky.all_stars.least);
  text += format("Attitude sigma of an axis, dots %g px: median %.2f\", 95 %% below %.2f\", worst %.2f\"\n",
                 s.options.dot_sigma, s.sky.attitude_sigma.median / kArcsec,
                 s.sky.attitude_sigma.high / kArcsec, s.sky.attitude_sigma.most / kArcsec);
  if (s.sky.unsolvable > 0)
    text += format("  %.1f %% of the attitudes see fewer than three stars\n", 100 * s.sky.unsolvable);
  return text;
}

std::string study_json(const std::vector<SymmetricRow>& rows, const DesignStudy* s) {
  nlohmann::ordered_json json;
  json["symmetric"] = nlohmann::ordered_json::array();
  for (const SymmetricRow& row : rows) {
    json["symmetric"].push_back({{"cameras", row.cameras},
                                 {"arrangement", symmetric_name(row.cameras)},
                                 {"needed", field_json(row.needed)},
                                 {"needed_at_infinity", field_json(row.needed_infinity)}});
  }
  if (s == nullptr) return json.dump(2) + "\n";
  nlohmann::ordered_json rig;
  rig["name"] = s->paper.rig.name.view();
  rig["needed"] = field_json(s->needed);
  rig["needed_at_infinity"] = field_json(s->needed_infinity);
  rig["coverage_at_distance"] = coverage_json(s->near);
  rig["coverage_at_infinity"] = coverage_json(s->infinity);
  rig["whole_sky_beyond_m"] =
      s->whole_sky_beyond ? nlohmann::ordered_json(*s->whole_sky_beyond) : nlohmann::ordered_json(nullptr);
  rig["box_m"] = {s->box.x(), s->box.y(), s->box.z()};
  rig["cameras"] = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < s->paper.rig.cameras.size(); ++c) {
    const RigCamera& camera = s->paper.rig.cameras[c];
    nlohmann::ordered_json one{{"name", camera.name.view()},
                               {"pixel_arcsec", camera.lens.pixel_angle() / kArcsec},
                               {"largest_off_axis_deg", s->paper.reach(c) / kDegree},
                               {"stars", spread_json(s->sky.stars[c], 1)}};
    if (!s->body.empty() && s->poses[c]) {
      one["pose"] = {{"targets", s->poses[c]->targets},
                     {"position_sigma_m", s->poses[c]->position_sigma},
                     {"rotation_sigma_deg", s->poses[c]->rotation_sigma / kDegree}};
    }
    rig["cameras"].push_back(one);
  }
  rig["stars"] = spread_json(s->sky.all_stars, 1);
  rig["attitude_sigma_arcsec"] = spread_json(s->sky.attitude_sigma, kArcsec);
  rig["unsolvable_share"] = s->sky.unsolvable;
  json["rig"] = rig;
  return json.dump(2) + "\n";
}

}  // namespace omma::ground
