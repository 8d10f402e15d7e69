// Lens files that others wrote, against truth that others established: the classic mistakes here are a
// mirrored image and swapped rows and columns, and only real stars show them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "components/catalogue/apparent_place.hpp"
#include "components/catalogue/star.hpp"
#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

const std::string kData = OMMA_SHARED_DATA "/data/";
constexpr double kDegree = std::numbers::pi / 180;

#define OMMA_NEEDS(file) \
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs the shared file " << (file)

nlohmann::json json_of(const std::string& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

class RealLensFile : public ::testing::TestWithParam<const char*> {};

TEST_P(RealLensFile, RoundTripOverTheWholeImageIsExact) {
  const std::string file = kData + GetParam();
  OMMA_NEEDS(file);
  const Lens lens = read_lens_file(file);
  double worst = 0;
  int seen = 0;
  int blind = 0;
  for (int v = 0; v < lens.height(); v += 3) {
    for (int u = 0; u < lens.width(); u += 3) {
      Eigen::Vector3d ray;
      Eigen::Vector2d pixel;
      if (!lens.bearing({u, v}, ray)) {
        ++blind;
        continue;
      }
      ++seen;
      ASSERT_TRUE(lens.project(ray, pixel)) << u << " " << v;
      worst = std::max(worst, (pixel - Eigen::Vector2d(u, v)).norm());
    }
  }
  std::printf("%s: largest angle %.2f deg, round trip %.1e px, no ray for %.2f %% of the pixels\n",
              GetParam(), lens.max_angle() / kDegree, worst, 100.0 * blind / (blind + seen));
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(seen, 1000);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealLensFile,
    ::testing::Values("calibration/ocamcalib/uvdar_bluefox_uv_fisheye_752x480.txt",
                      "calibration/ocamcalib/matsuren_1600x1600.txt",
                      "calibration/bouguet/whycon_5184x3456_Calib_Results.m",
                      "calibration/kalibr/kalibr_workingdir_camchain_imucam_kb4_640x480.yaml",
                      "sky/kho/LYR-Sony-111220_200933_gray2_calib_results.txt",
                      "sky/indi/20210421_043940_calib_results.txt",
                      "sky/stellarium/lens/fisheye_244.5px_1024x768.txt",
                      "sky/stellarium/lens/fisheye_480.9px_1024x768.txt",
                      "sky/stellarium/lens/perspective_384.0px_1024x768.txt",
                      "sky/stellarium/lens/stereographic_250.2px_1024x768.txt",
                      "sky/stellarium/lens/equalarea_271.5px_1024x768.txt"));

TEST(RealLens, StellariumEquidistantFilesAgreeWithFocalTimesAngle) {
  for (const char* name : {"244.5", "293.4", "313.7", "360.7", "480.9"}) {
    const std::string file = kData + "sky/stellarium/lens/fisheye_" + name + "px_1024x768.txt";
    OMMA_NEEDS(file);
    const Lens lens = read_lens_file(file);
    const double f = 1 / lens.pixel_angle();
    // The exact focal length is in the truth file's images; the name has one decimal.
    EXPECT_NEAR(f, std::stod(name), 0.1);
    double best_rms = 1e9;
    for (double focal = std::stod(name) - 0.1; focal < std::stod(name) + 0.1; focal += 0.001) {
      double sum = 0;
      int count = 0;
      for (double theta = 0.01; theta < 93 * kDegree; theta += 0.01) {
        Eigen::Vector2d pixel;
        if (!lens.project({std::sin(theta), 0, std::cos(theta)}, pixel)) continue;
        sum += std::pow(pixel.x() - 511.5 - focal * theta, 2) + std::pow(pixel.y() - 383.5, 2);
        ++count;
      }
      best_rms = std::min(best_rms, std::sqrt(sum / count));
    }
    EXPECT_LT(best_rms, 0.006) << name;
  }
}

Eigen::Matrix3d matrix_of(const nlohmann::json& rows) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      m(i, k) = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(k)).get<double>();
  }
  return m;
}

TEST(RealLens, StellariumShotsHaveTheirTruthFocalLength) {
  const std::string truth = kData + "sky/stellarium/rig/truth.json";
  OMMA_NEEDS(truth);
  const auto shots = json_of(truth)["shots"];
  for (const auto& shot : shots) {
    const double f = shot["f_px"];
    char name[64];
    std::snprintf(name, sizeof name, "fisheye_%.1fpx_1024x768.txt", f);
    const Lens lens = read_lens_file(kData + "sky/stellarium/lens/" + name);
    const Lens exact = Lens::equidistant(
        1024, 768, f, Eigen::Vector2d(shot["cx"].get<double>(), shot["cy"].get<double>()), 100 * kDegree);
    double sum = 0;
    int count = 0;
    for (double v = 0; v < 768; v += 16) {
      for (double u = 0; u < 1024; u += 16) {
        Eigen::Vector3d ray;
        Eigen::Vector2d pixel;
        if (!exact.bearing({u, v}, ray) || !lens.project(ray, pixel)) continue;
        sum += (pixel - Eigen::Vector2d(u, v)).squaredNorm();
        ++count;
      }
    }
    EXPECT_GT(count, 2000);
    EXPECT_LT(std::sqrt(sum / count), 0.006) << name;
  }
}

std::map<int, const CatalogueStar*> catalogue_by_number() {
  std::map<int, const CatalogueStar*> stars;
  for (const CatalogueStar& star : bright_star_catalogue()) stars[star.hr] = &star;
  return stars;
}

TEST(RealLens, LongyearbyenStarsFallOnTheirPixels) {
  const std::string base = kData + "sky/kho/LYR-Sony-111220_200933_gray2_";
  OMMA_NEEDS(base + "truth.json");
  const auto truth = json_of(base + "truth.json");
  const Lens lens = read_lens_file(base + "calib_results.txt");
  const Eigen::Matrix3d camera_from_j2000 = matrix_of(truth["C_cam_from_J2000"]);
  ASSERT_NEAR(camera_from_j2000.determinant(), 1, 1e-9);
  Observer observer;
  observer.julian_date_utc = truth["utc_jd"].get<double>();
  observer.site =
      GroundSite{truth["lat"].get<double>() * kDegree, truth["lon"].get<double>() * kDegree, 0, {}, {}};
  const ApparentPlace place(observer);
  const auto catalogue = catalogue_by_number();
  double sum = 0;
  double backwards = 0;
  int count = 0;
  for (const auto& entry : truth["stars"]) {
    const auto star = catalogue.find(entry["HR"].get<int>());
    ASSERT_NE(star, catalogue.end());
    Eigen::Vector3d direction;
    ASSERT_TRUE(place.direction(*star->second, direction));
    direction = camera_from_j2000 * direction;
    const Eigen::Vector2d listed(entry["x"].get<double>(), entry["y"].get<double>());
    Eigen::Vector2d pixel;
    ASSERT_TRUE(lens.project(direction, pixel)) << entry["HR"];
    sum += (pixel - listed).squaredNorm();
    Eigen::Vector3d ray;
    ASSERT_TRUE(lens.bearing(listed, ray));
    backwards += ray.cross(direction).squaredNorm();
    ++count;
  }
  const double rms = std::sqrt(sum / count);
  const double rms_arcsec = std::sqrt(backwards / count) / kDegree * 3600;
  std::printf("%d stars: %.3f px rms, %.0f arcsec rms\n", count, rms, rms_arcsec);
  EXPECT_EQ(count, 329);
  EXPECT_LT(rms, 0.32);  // 0.20 px of the fit and up to 0.25 px between the file and the fitted model
  EXPECT_LT(rms_arcsec, 170);
}

TEST(RealLens, IndiStarsFallOnTheirPixels) {
  const std::string base = kData + "sky/indi/20210421_043940_";
  OMMA_NEEDS(base + "truth.json");
  const auto truth = json_of(base + "truth.json");
  const Lens lens = read_lens_file(base + "calib_results.txt");
  const Eigen::Matrix3d camera_from_j2000 = matrix_of(truth["C_cam_from_J2000"]);
  Observer observer;  // the site is unknown: the fitted lens and attitude contain the refraction
  observer.julian_date_utc = truth["utc_jd_assumed_EDT"].get<double>();
  const ApparentPlace place(observer);
  const auto catalogue = catalogue_by_number();
  double sum = 0;
  int count = 0;
  for (const auto& entry : truth["stars"]) {
    const auto star = catalogue.find(entry["HR"].get<int>());
    ASSERT_NE(star, catalogue.end());
    Eigen::Vector3d direction;
    ASSERT_TRUE(place.direction(*star->second, direction));
    Eigen::Vector2d pixel;
    ASSERT_TRUE(lens.project(camera_from_j2000 * direction, pixel)) << entry["HR"];
    sum += (pixel - Eigen::Vector2d(entry["x"].get<double>(), entry["y"].get<double>())).squaredNorm();
    ++count;
  }
  std::printf("%d stars: %.3f px rms\n", count, std::sqrt(sum / count));
  EXPECT_LT(std::sqrt(sum / count), 1.2);  // 0.79 px of the fit, trailed stars
}

TEST(RealLens, KalibrModelsOutsideOursAreRefused) {
  const std::string omni = kData + "calibration/kalibr/kalibr_wiki_omni_radtan_752x480.yaml";
  OMMA_NEEDS(omni);
  EXPECT_THROW(read_lens_file(omni), InputError);
}

}  // namespace
}  // namespace omma
