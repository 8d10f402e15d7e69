// omma-bench rig_calibration: extrinsic errors of a rig calibrated on cards, one adjustment of all images
// against one image a camera, and NEES. Options: --rig FILE (default: the dissertation's), --trials N, --sets
// N, --noise-mpx N (deviation of a dot per axis, thousandths of a pixel).
#include <cmath>
#include <cstdio>

#include "components/geometry/rig_file.hpp"
#include "ground/report/statistics.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
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

int bench_rig_calibration(int argc, char** argv) {
  const std::string file = text_option(argc, argv, "--rig", OMMA_SOURCE_DIR "/config/rigs/dissertation.toml");
  const int trials = std::max(1, option(argc, argv, "--trials", 40));
  const int sets = std::max(2, option(argc, argv, "--sets", 20));
  const double noise = 1e-3 * option(argc, argv, "--noise-mpx", 100);
  const Rig rig = read_rig_file(file);
  Errors joint, one;
  std::vector<double> nees;
  int failed = 0;
  double images = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const RoomOfCards room = room_of_cards(rig, sets, noise, static_cast<std::uint64_t>(trial));
    const ground::RigCalibration found = ground::calibrate_rig(rig, room.bodies, room.views, {4.0, false});
    images += double(room.views.size()) / trials;
    if (!found.done) {
      ++failed;
      continue;
    }
    for (std::size_t c = 1; c < rig.cameras.size(); ++c) {
      const Pose& truth = room.truth.rig_from_camera[c];
      const Vector6d error = error_of(found.rig.cameras[c].rig_from_camera, truth);
      joint.add(error);
      nees.push_back(ground::squared_in_sigmas<6>(error, found.adjustment.camera_covariance(c)));
      if (found.one_image[c]) one.add(error_of(*found.one_image[c], truth));
    }
  }
  std::printf("%s: %d trials of %d frame sets, %.1f images of cards, dots good to %.3f px\n",
              rig.name.c_str(), trials, sets, images, noise);
  one.print("one image a camera");
  joint.print("one adjustment of all images");
  const ground::MeanNees mean = ground::mean_nees(nees, 6);
  std::printf("NEES %.2f of 6 (%.2f to %.2f), %d of %d trials failed\n", mean.mean, mean.low, mean.high,
              failed, trials);
  return 0;
}

}  // namespace omma
