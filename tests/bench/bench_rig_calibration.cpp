// omma-bench rig_calibration: extrinsic errors of a rig calibrated on cards, one adjustment of all images
// against one image a camera, and NEES.
#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>

#include "components/geometry/rig_file.hpp"
#include "ground/report/statistics.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/room_of_cards.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr double kArcsec = M_PI / 180 / 3600;

Vector6d error_of(const Pose& found, const Pose& truth) {
  Vector6d error;
  error << rotation_log(truth.rotation * found.rotation.conjugate()), truth.translation - found.translation;
  return error;
}

// Squared in standard deviations; the covariance's first block is the cameras'.
double in_sigmas(const Eigen::VectorXd& error, const Eigen::MatrixXd& all) {
  const Eigen::MatrixXd covariance = all.topLeftCorner(error.size(), error.size());
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::VectorXd scaled = scale.cwiseProduct(error);
  return scaled.dot(correlation.ldlt().solve(scaled));
}

struct Errors {
  double turn = 0;  // sum of squared lengths
  double shift = 0;
  int count = 0;
  void add(const Vector6d& e) {
    turn += e.head<3>().squaredNorm();
    shift += e.tail<3>().squaredNorm();
    ++count;
  }
  void print(const char* way) const {
    std::printf("%-34s rotation %8.1f arcsec, position %7.3f mm rms (three axes, %d cameras)\n", way,
                std::sqrt(turn / count) / kArcsec, 1e3 * std::sqrt(shift / count), count);
  }
};

}  // namespace

int bench_rig_calibration(Options& options) {
  std::string file = OMMA_SOURCE_DIR "/config/rigs/dissertation.toml";
  int trials = 40;
  int sets = 20;
  int seed = 0;
  int noise_mpx = 100;
  options.add("--rig", file, "that is calibrated");
  options.add("--trials", trials, "rooms of cards");
  options.add("--sets", sets, "frame sets of a room", 2);
  options.add("--seed", seed, "of the first trial", 0);
  options.add("--noise-mpx", noise_mpx, "deviation of a dot per axis [thousandths of a pixel]");
  options.read();
  const double noise = 1e-3 * noise_mpx;
  const Rig rig = read_rig_file(file);
  Errors joint, one;
  std::vector<double> nees;   // of each camera
  std::vector<double> whole;  // of all cameras of a trial at once: trials are independent, cameras are not
  int failed = 0;
  double images = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const RoomOfCards room = room_of_cards(rig, sets, noise, static_cast<std::uint64_t>(seed + trial));
    const ground::RigCalibration found = ground::calibrate_rig(rig, room.bodies, room.views, {4.0, false});
    images += double(room.views.size()) / trials;
    if (!found.done) {
      if (++failed <= 3) std::printf("trial %d: %s\n", seed + trial, found.reason.c_str());
      continue;
    }
    Eigen::VectorXd errors(6 * (static_cast<Eigen::Index>(rig.cameras.size()) - 1));
    for (std::size_t c = 1; c < rig.cameras.size(); ++c) {
      const Pose& truth = room.truth.rig_from_camera[c];
      const Vector6d error = error_of(found.rig.cameras[c].rig_from_camera, truth);
      joint.add(error);
      nees.push_back(ground::squared_in_sigmas<6>(error, found.adjustment.camera_covariance(c)));
      errors.segment<6>(6 * (static_cast<Eigen::Index>(c) - 1)) = error;
      if (found.one_image[c]) one.add(error_of(*found.one_image[c], truth));
    }
    whole.push_back(in_sigmas(errors, found.adjustment.covariance));
  }
  std::printf("%s: %d trials of %d frame sets, %.1f images of cards, dots good to %.3f px\n",
              rig.name.c_str(), trials, sets, images, noise);
  one.print("one image a camera");
  joint.print("one adjustment of all images");
  double camera_mean = 0;
  for (const double n : nees) camera_mean += n / static_cast<double>(nees.size());
  const int unknowns = 6 * (static_cast<int>(rig.cameras.size()) - 1);
  const ground::MeanNees mean = ground::mean_nees(whole, unknowns);
  std::printf("NEES of all cameras of a trial together %.2f of %d (%.2f to %.2f); of one camera %.2f of 6\n",
              mean.mean, unknowns, mean.low, mean.high, camera_mean);
  std::printf("%d of %d trials failed\n", failed, trials);
  return 0;
}

}  // namespace omma
