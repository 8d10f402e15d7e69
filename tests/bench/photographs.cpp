#include "tests/bench/photographs.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "components/geometry/lens_file.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;

json json_of(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

/// The rotation nearest to the nine printed numbers.
Eigen::Matrix3d rotation_of(const json& rows) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      m(i, k) = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(k)).get<double>();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// Camera axes (x right, y down, z out of the lens) that look at a place with north `roll` east of image up.
Eigen::Matrix3d looking_at(double right_ascension, double declination, double roll) {
  const double sa = std::sin(right_ascension);
  const double ca = std::cos(right_ascension);
  const double sd = std::sin(declination);
  const double cd = std::cos(declination);
  const Eigen::Vector3d axis(cd * ca, cd * sa, sd);
  const Eigen::Vector3d north(-sd * ca, -sd * sa, cd);
  const Eigen::Vector3d east(-sa, ca, 0);
  const Eigen::Vector3d up = std::cos(roll) * north + std::sin(roll) * east;
  Eigen::Matrix3d camera_from_j2000;
  camera_from_j2000.row(0) = axis.cross(up);
  camera_from_j2000.row(1) = -up;
  camera_from_j2000.row(2) = axis;
  return camera_from_j2000;
}

RigCamera camera_named(const std::string& name, const Lens& lens) {
  RigCamera camera;
  camera.name = Name(name);
  camera.lens = lens;
  return camera;
}

Photograph single(const std::string& name, const fs::path& image, const fs::path& lens,
                  const Eigen::Matrix3d& truth, double tolerance) {
  Photograph photograph;
  photograph.name = name;
  photograph.images = {image};
  photograph.lenses = {lens};
  photograph.rig.cameras.push_back(camera_named("cam0", read_lens_file(lens)));
  photograph.rig_from_j2000 = truth;
  photograph.tolerance_arcsec = Eigen::Vector3d::Constant(tolerance);
  return photograph;
}

std::vector<Photograph> longyearbyen(const fs::path& sky) {
  const std::string base = sky / "kho" / "LYR-Sony-111220_200933_gray2";
  const json truth = json_of(base + "_truth.json");
  // The truth was fitted with another lens model: the files differ by up to 0.25 px rms, 105".
  Photograph photograph =
      single("kho", base + ".png", base + "_calib_results.txt", rotation_of(truth["C_cam_from_J2000"]), 150);
  photograph.epoch = "2020-12-11T20:09:33Z";
  photograph.site = "78.148,16.043,0";
  photograph.observer.julian_date_utc = parse_utc(photograph.epoch);
  photograph.observer.site = parse_ground_site(photograph.site);
  Photograph no_hint = photograph;
  no_hint.name = "kho, no epoch, no site";
  no_hint.observer = {};
  no_hint.epoch.clear();
  no_hint.site.clear();
  return {photograph, no_hint};
}

std::vector<Photograph> indi(const fs::path& sky) {
  const std::string base = sky / "indi" / "20210421_043940";
  const json truth = json_of(base + "_truth.json");
  // Trailed stars, 0.79 px rms of 272" each, and refraction in the fitted lens.
  Photograph photograph =
      single("indi", base + ".jpg", base + "_calib_results.txt", rotation_of(truth["C_cam_from_J2000"]), 150);
  return {photograph};
}

std::vector<Photograph> medium_field(const fs::path& sky) {
  // openstartracker's own calibration of its camera: 15.7768356" a pixel.
  constexpr double kOpenStarTrackerPixel = 15.7768356032;
  std::vector<Photograph> found;
  const json solutions = json_of(sky / "medium_fov" / "solutions.json");
  for (const auto& [key, entry] : solutions.items()) {
    Photograph photograph;
    photograph.name = key.substr(key.find('/') + 1);
    photograph.images = {sky / "medium_fov" / photograph.name};
    const int width = entry["size"][0];
    const int height = entry["size"][1];
    const json& solved = entry["cedar_solve"];
    photograph.has_truth = !solved["RA"].is_null();
    photograph.fov_deg = photograph.has_truth
                             ? solved["FOV"].get<double>()
                             : 2 * std::atan(0.5 * width * kOpenStarTrackerPixel * kArcsecond) / kDegree;
    photograph.rig.cameras.push_back(
        camera_named("cam0", Lens::pinhole(width, height, photograph.fov_deg * kDegree)));
    if (photograph.has_truth) {
      // cedar-solve's roll turns the other way; astrometry.net models the distortion, so its centre is taken.
      photograph.rig_from_j2000 = looking_at(entry["astrometry_net_center"][0].get<double>() * kDegree,
                                             entry["astrometry_net_center"][1].get<double>() * kDegree,
                                             -solved["Roll"].get<double>() * kDegree);
      photograph.tolerance_arcsec = Eigen::Vector3d(60, 60, 600);
    }
    found.push_back(photograph);
  }
  return found;
}

fs::path lens_of(const fs::path& sky, const json& shot) {
  const std::string projection = shot["projection"];
  const std::string kind = projection == "Fisheye"     ? "fisheye"
                           : projection == "EqualArea" ? "equalarea"
                                                       : "perspective";
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "%s_%.1fpx_%dx%d.txt", kind.c_str(), shot["f_px"].get<double>(),
                shot["width"].get<int>(), shot["height"].get<int>());
  return sky / "stellarium" / "lens" / name.data();
}

// Each image alone.
std::vector<Photograph> stellarium(const fs::path& sky, const std::string& folder) {
  std::vector<Photograph> found;
  const fs::path place = sky / "stellarium" / folder;
  const json truth = json_of(place / "truth.json");
  for (const json& shot : truth["shots"]) {
    const std::string file = shot["file"];
    found.push_back(
        single(file, place / file, lens_of(sky, shot), rotation_of(shot["C_cam_from_J2000"]), 60));
  }
  return found;
}

std::vector<Photograph> rigs(const fs::path& sky) {
  std::vector<Photograph> found;
  const fs::path place = sky / "stellarium" / "rig";
  const json truth = json_of(place / "truth.json");
  for (const json& shot : truth["shots"]) {
    const auto attitude = shot["attitude"].get<std::size_t>();
    if (found.size() <= attitude) found.resize(attitude + 1);
    Photograph& photograph = found[attitude];
    photograph.name = "rig, attitude " + std::to_string(attitude);
    photograph.rig.name = Name("stellarium");
    photograph.images.push_back(place / shot["file"].get<std::string>());
    photograph.lenses.push_back(lens_of(sky, shot));
    RigCamera camera =
        camera_named("cam" + std::to_string(shot["camera"].get<int>()), read_lens_file(lens_of(sky, shot)));
    camera.rig_from_camera.rotation =
        Eigen::Quaterniond(rotation_of(shot["C_cam_from_body"]).transpose().eval());
    photograph.rig.cameras.push_back(camera);
    photograph.rig_from_j2000 = rotation_of(shot["C_body_from_J2000"]);
    photograph.tolerance_arcsec = Eigen::Vector3d::Constant(30);
  }
  return found;
}

}  // namespace

const char* name_of(PhotographGroup group) {
  switch (group) {
    case PhotographGroup::kLongyearbyen:
      return "Longyearbyen fisheye";
    case PhotographGroup::kIndi:
      return "indi all-sky";
    case PhotographGroup::kMediumField:
      return "medium fields";
    case PhotographGroup::kRigs:
      return "rigs, jointly";
    case PhotographGroup::kRigImages:
      return "rig images, each alone";
    case PhotographGroup::kSingles:
      return "singles";
    case PhotographGroup::kClutter:
      return "clutter";
  }
  return "";
}

std::vector<Photograph> photographs(const fs::path& data, PhotographGroup group) {
  const fs::path sky = data / "sky";
  if (!fs::exists(sky)) return {};
  switch (group) {
    case PhotographGroup::kLongyearbyen:
      return longyearbyen(sky);
    case PhotographGroup::kIndi:
      return indi(sky);
    case PhotographGroup::kMediumField:
      return medium_field(sky);
    case PhotographGroup::kRigs:
      return rigs(sky);
    case PhotographGroup::kRigImages:
      return stellarium(sky, "rig");
    case PhotographGroup::kSingles:
      return stellarium(sky, "single");
    case PhotographGroup::kClutter:
      return stellarium(sky, "clutter");
  }
  return {};
}

Eigen::Vector3d error_arcsec(const Photograph& photograph, const Eigen::Quaterniond& rig_from_j2000) {
  const Eigen::Quaterniond truth(photograph.rig_from_j2000);
  return rotation_log(rig_from_j2000 * truth.conjugate()) / kArcsecond;
}

}  // namespace omma
