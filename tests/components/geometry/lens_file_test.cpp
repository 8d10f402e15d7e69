// Lens files: what is right is read, what is wrong is named with its line and field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "tests/components/geometry/temporary_file.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const kOcam =
    "#first record\n"                                               // 1
    "\n"                                                            // 2
    "5 -2.595395e+02 0 1.626945e-03 -2.328091e-06 6.601777e-09 \n"  // 3
    "\n"                                                            // 4
    "#second record\n"                                              // 5
    "3 388.5 220.9 -10.1\n"                                         // 6
    "#center\n"                                                     // 7
    "229.581672 364.430465\n"                                       // 8
    "#affine\n"                                                     // 9
    "1.000314 -0.000012 -0.000158\n"                                // 10
    "#size\n"                                                       // 11
    "480 752\n";                                                    // 12

const char* const kBouguet =
    "% comment\n"
    "fc = [ 658.25 ; 657.11 ];\n"
    "cc = [ 302.5 ; 243.4 ];\n"
    "alpha_c = 0.001;\n"
    "kc = [ -0.25 ; 0.12 ; -0.0003 ; 0.0002 ; 0.01 ];\n"
    "fc_error = [ 0.3 ; 0.3 ];\n"
    "nx = 640;\n"
    "ny = 480;\n"
    "omc_1 = [ 1.6 ;\n 1.8 ;\n -0.6 ];\n";

const char* const kKalibr =
    "cam0:\n"
    "  camera_model: pinhole\n"
    "  intrinsics: [274.5, 275.3, 313.6, 251.5]\n"
    "  distortion_model: equidistant\n"
    "  distortion_coeffs: [-0.027, 0.095, -0.113, 0.051]\n"
    "  resolution: [640, 480]\n"
    "cam1:\n"
    "  camera_model: pinhole\n"
    "  intrinsics: [461.6, 460.1, 362.6, 248.1]\n"
    "  distortion_model: radtan\n"
    "  distortion_coeffs: [-0.27, 0.06, 0.001, 0.0002]\n"
    "  resolution: [752, 480]\n"
    "  T_cn_cnm1:\n"
    "  - [1.0, 0.0, 0.0, 0.1]\n";

std::string with(std::string text, const std::string& old, const std::string& fresh) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), fresh);
}

std::string error_of(const std::string& name, const std::string& text, const std::string& camera = "") {
  const TemporaryFile file(name, text);
  return refusal_of([&] { read_lens_file(file.path() + camera); });
}

void expect_same(const Lens& a, const Lens& b) {
  for (double v = 5; v < a.height(); v += 60) {
    for (double u = 5; u < a.width(); u += 60) {
      Eigen::Vector3d ray_a = Eigen::Vector3d::Zero();
      Eigen::Vector3d ray_b = Eigen::Vector3d::Zero();
      ASSERT_EQ(a.bearing({u, v}, ray_a), b.bearing({u, v}, ray_b));
      EXPECT_LT((ray_a - ray_b).norm(), 1e-12);
    }
  }
}

TEST(OcamFile, RowsAndColumnsBecomeOurAxes) {
  const Lens lens = lens_from_ocamcalib(kOcam, "lens.txt");
  EXPECT_EQ(lens.model(), LensModel::kOcam);
  EXPECT_EQ(lens.width(), 752);
  EXPECT_EQ(lens.height(), 480);
  EXPECT_DOUBLE_EQ(lens.centre().x(), 364.430465);
  EXPECT_DOUBLE_EQ(lens.centre().y(), 229.581672);
  // The toolbox's cam2world, written out for one pixel: [x; y] = A⁻¹ ([row; col] − centre), ray (x, y, P(ρ)).
  const double row = 130;
  const double column = 500;
  Eigen::Matrix2d a;
  a << 1.000314, -0.000012, -0.000158, 1;
  const Eigen::Vector2d m = a.inverse() * Eigen::Vector2d(row - 229.581672, column - 364.430465);
  const double rho = m.norm();
  const double p = -2.595395e+02 + 1.626945e-03 * rho * rho - 2.328091e-06 * std::pow(rho, 3) +
                   6.601777e-09 * std::pow(rho, 4);
  const Eigen::Vector3d toolbox = Eigen::Vector3d(m.x(), m.y(), p).normalized();
  Eigen::Vector3d ray;
  ASSERT_TRUE(lens.bearing({column, row}, ray));
  EXPECT_NEAR(ray.x(), toolbox.y(), 1e-12);   // right is its y
  EXPECT_NEAR(ray.y(), toolbox.x(), 1e-12);   // down is its x
  EXPECT_NEAR(ray.z(), -toolbox.z(), 1e-12);  // its axis points backwards
}

TEST(OcamFile, BothSignsOfThePolynomialAreTheSameLens) {
  const std::string flipped = with(kOcam, "5 -2.595395e+02 0 1.626945e-03 -2.328091e-06 6.601777e-09",
                                   "5 +2.595395e+02 0 -1.626945e-03 2.328091e-06 -6.601777e-09");
  expect_same(lens_from_ocamcalib(kOcam, "a"), lens_from_ocamcalib(flipped, "b"));
}

TEST(OcamFile, CommentLinesAndLineEndingsDoNotMatter) {
  std::string dos;
  for (const char c : std::string(kOcam)) dos += c == '\n' ? "\r\n" : std::string(1, c);
  expect_same(lens_from_ocamcalib(kOcam, "a"), lens_from_ocamcalib(dos, "b"));
  const std::string bare = "1 -300\n1 2\n100 100\n1 0 0\n200 200";
  EXPECT_EQ(lens_from_ocamcalib(bare, "c").height(), 200);
}

TEST(OcamFile, WrongRecordsAreNamedWithTheirLine) {
  EXPECT_THAT(
      error_of("a.txt", with(kOcam, "5 -2.59", "4 -2.59")),
      AllOf(HasSubstr("a.txt:3: polynomial: expected the end of the record, found \"6.601777e-09\"")));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "5 -2.59", "6 -2.59")),
              HasSubstr("a.txt:3: polynomial a5: expected a number, found the end of the record"));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "5 -2.595395e+02", "5 nan")),
              HasSubstr("a.txt:3: polynomial a0: expected a finite number, found \"nan\""));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "5 -2.595395e+02", "5 0.0")),
              HasSubstr("a.txt:3: polynomial a0: expected a focal length other than zero, found 0"));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "5 -2.59", "17 -2.59")),
              HasSubstr("a.txt:3: polynomial length: expected a whole number from 1 to 16, found \"17\""));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "229.581672 364.430465\n", "")),
              HasSubstr("a.txt:9: centre: expected the end of the record, found \"-0.000158\""));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "364.430465", "x")),
              HasSubstr("a.txt:8: centre column: expected a finite number, found \"x\""));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "364.430465", "1e9")), HasSubstr("a.txt:8: centre: expected"));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "1.000314", "0")),
              HasSubstr("a.txt:10: affine: expected c - d e above zero"));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "480 752", "480 -752")), HasSubstr("a.txt:12: image width"));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "480 752", "480 752.5")), HasSubstr("a.txt:12: image width"));
  EXPECT_THAT(error_of("a.txt", with(kOcam, "480 752", "480 752 3")),
              HasSubstr("a.txt:12: image size: expected the end of the record, found \"3\""));
}

TEST(OcamFile, TruncatedAnywhereIsRefused) {
  const std::string text = kOcam;
  const std::size_t last_number = text.rfind("752");
  for (std::size_t length = 0; length < last_number; ++length) {
    EXPECT_THROW(lens_from_ocamcalib(text.substr(0, length), "cut"), InputError) << length;
  }
}

TEST(BouguetFile, IsRead) {
  const TemporaryFile file("Calib_Results.m", kBouguet);
  const Lens lens = read_lens_file(file.path());
  ASSERT_EQ(lens.model(), LensModel::kCaltech);
  EXPECT_EQ(lens.width(), 640);
  EXPECT_EQ(lens.height(), 480);
  EXPECT_DOUBLE_EQ(lens.centre().x(), 302.5);
  EXPECT_DOUBLE_EQ(lens.affine()(0, 0), 658.25);
  EXPECT_DOUBLE_EQ(lens.affine()(0, 1), 658.25 * 0.001);
  EXPECT_DOUBLE_EQ(lens.caltech_model()->coefficients()[4], 0.01);
  // Bouguet's own formula for one direction.
  const double x = 0.2;
  const double y = -0.1;
  const double r2 = x * x + y * y;
  const double radial = 1 - 0.25 * r2 + 0.12 * r2 * r2 + 0.01 * r2 * r2 * r2;
  const double xd = radial * x + 2 * -0.0003 * x * y + 0.0002 * (r2 + 2 * x * x);
  const double yd = radial * y + -0.0003 * (r2 + 2 * y * y) + 2 * 0.0002 * x * y;
  Eigen::Vector2d pixel;
  ASSERT_TRUE(lens.project({x, y, 1}, pixel));
  EXPECT_NEAR(pixel.x(), 658.25 * (xd + 0.001 * yd) + 302.5, 1e-10);
  EXPECT_NEAR(pixel.y(), 657.11 * yd + 243.4, 1e-10);
}

TEST(BouguetFile, FourDistortionTermsAndListsOverSeveralLinesAreRead) {
  const Lens lens = lens_from_bouguet(with(kBouguet, "kc = [ -0.25 ; 0.12 ; -0.0003 ; 0.0002 ; 0.01 ]",
                                           "kc = [ -0.25\n 0.12\n -0.0003\n 0.0002 ]"),
                                      "a.m");
  EXPECT_DOUBLE_EQ(lens.caltech_model()->coefficients()[3], 0.0002);
  EXPECT_DOUBLE_EQ(lens.caltech_model()->coefficients()[4], 0);
}

TEST(BouguetFile, WrongRecordsAreNamedWithTheirLine) {
  EXPECT_THAT(error_of("a.m", with(kBouguet, "fc = [", "gc = [")),
              HasSubstr("fc: expected 2 numbers, found no such assignment in the file"));
  EXPECT_THAT(error_of("a.m", with(kBouguet, "658.25", "0.0")),
              HasSubstr("a.m:2: fc: expected focal lengths above zero"));
  EXPECT_THAT(error_of("a.m", with(kBouguet, "658.25", "NaN")),
              HasSubstr("a.m:2: fc: expected finite numbers, found \"NaN\""));
  EXPECT_THAT(error_of("a.m", with(kBouguet, " ; 657.11", "")),
              HasSubstr("a.m:2: fc: expected 2 numbers, found 1"));
  EXPECT_THAT(error_of("a.m", with(kBouguet, " ; 0.0002 ; 0.01", "")),
              HasSubstr("a.m:5: kc: expected 4 or 5 numbers, found 3"));
  EXPECT_THAT(error_of("a.m", with(kBouguet, "nx = 640", "nx = 640.5")),
              HasSubstr("a.m:7: nx: expected a whole number of pixels"));
  EXPECT_THAT(error_of("a.m", std::string(kBouguet).substr(0, 120)), HasSubstr("expected"));
}

TEST(KalibrFile, CamerasOfAChainAreChosenByName) {
  const TemporaryFile file("chain.yaml", kKalibr);
  const Lens fisheye = read_lens_file(file.path() + "#cam0");
  ASSERT_EQ(fisheye.model(), LensModel::kKannalaBrandt);
  EXPECT_EQ(fisheye.width(), 640);
  EXPECT_DOUBLE_EQ(fisheye.kannala_brandt_model()->coefficients()[1], 0.095);
  const Lens pinhole = read_lens_file(file.path() + "#cam1");
  ASSERT_EQ(pinhole.model(), LensModel::kCaltech);
  EXPECT_DOUBLE_EQ(pinhole.caltech_model()->coefficients()[2], 0.001);
  EXPECT_DOUBLE_EQ(pinhole.caltech_model()->coefficients()[4], 0);
  EXPECT_THAT(refusal_of([&] { read_lens_file(file.path()); }),
              HasSubstr("expected FILE#CAMERA with one of cam0, cam1, found no camera named"));
  EXPECT_THAT(refusal_of([&] { read_lens_file(file.path() + "#cam7"); }),
              HasSubstr("expected one of cam0, cam1, found \"cam7\""));
}

TEST(KalibrFile, PinholeWithoutDistortionIsRead) {
  const Lens lens =
      lens_from_kalibr(with(kKalibr, "distortion_model: radtan", "distortion_model: none"), "a", "cam1");
  Eigen::Vector2d pixel;
  ASSERT_TRUE(lens.project({0.5, 0.1, 1}, pixel));
  EXPECT_NEAR(pixel.x(), 461.6 * 0.5 + 362.6, 1e-10);
}

TEST(KalibrFile, WrongRecordsAreNamedWithTheirLine) {
  EXPECT_THAT(error_of("a.yaml", with(kKalibr, "camera_model: pinhole", "camera_model: omni"), "#cam0"),
              HasSubstr("a.yaml:2: cam0.camera_model: expected pinhole (with distortion_model radtan, "
                        "equidistant or none), found \"omni\""));
  EXPECT_THAT(
      error_of("a.yaml", with(kKalibr, "distortion_model: equidistant", "distortion_model: fov"), "#cam0"),
      HasSubstr("a.yaml:4: cam0.distortion_model: expected radtan, equidistant or none, found \"fov\""));
  EXPECT_THAT(error_of("a.yaml", with(kKalibr, "[274.5, 275.3", "[0, 275.3"), "#cam0"),
              HasSubstr("a.yaml:3: cam0.intrinsics: expected focal lengths above zero"));
  EXPECT_THAT(
      error_of("a.yaml", with(kKalibr, "[274.5, 275.3", "[.nan, 275.3"), "#cam0"),
      HasSubstr("a.yaml:3: cam0.intrinsics: expected a list of 4 finite numbers, found \".nan\" among them"));
  EXPECT_THAT(error_of("a.yaml", with(kKalibr, "[274.5, 275.3, 313.6", "[274.5, 275.3"), "#cam0"),
              HasSubstr("a.yaml:3: cam0.intrinsics: expected a list of 4 finite numbers, found a list of 3"));
  EXPECT_THAT(error_of("a.yaml", with(kKalibr, "  resolution: [640, 480]\n", ""), "#cam0"),
              HasSubstr("cam0.resolution: expected a list of 2 finite numbers, found nothing"));
  EXPECT_THAT(error_of("a.yaml", "cam0: [1, 2\n"), HasSubstr("syntax: expected YAML"));
  EXPECT_THAT(error_of("a.yaml", "target_type: 'aprilgrid'\n"),
              HasSubstr("expected a camera with camera_model, found none"));
}

TEST(LensFile, WhatIsNoLensFileIsRefusedInOneSentence) {
  EXPECT_THAT(refusal_of([] { read_lens_file("/no/such/lens.txt"); }),
              HasSubstr("/no/such/lens.txt: file: expected a readable file, found no such file"));
  EXPECT_THAT(refusal_of([] { read_lens_file(testing::TempDir()); }), HasSubstr("something else"));
  EXPECT_THAT(error_of("empty.txt", ""), HasSubstr("the end of the file"));
  const std::string binary = error_of("picture.txt", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11));
  EXPECT_THAT(binary, HasSubstr("polynomial length: expected a whole number"));
  EXPECT_EQ(binary.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace omma
