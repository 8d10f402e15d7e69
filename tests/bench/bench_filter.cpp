// omma-bench filter: the attitude filter over many random flights: error against the single frame set's, NEES
// of attitude, of rate (with a gyro: of its bias) and of both, attitudes refused, time a frame set.
#include <Eigen/LU>
#include <cstdio>
#include <numbers>

#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/turning_rig.hpp"

namespace omma {
namespace {

constexpr double kArcsecond = std::numbers::pi / 180 / 3600;
constexpr int kSettling = 20;  // frame sets left out of the statistics

struct Case {
  const char* name;
  TurningRigOptions rig;
  int gap_of = 0;    // frame sets without an attitude, out of every hundred, in a row
  int wrong_of = 0;  // attitudes wrong by a degree, out of every hundred
  bool gyro_gap = false;
};

struct Sums {
  double attitude = 0, single = 0, drift = 0, nees3 = 0, nees_drift = 0, nees6 = 0;
  int samples = 0, refused = 0, started = 0;
  std::vector<double> times;
};

void fly(const Case& c, int frames, std::uint64_t seed, Sums& sums) {
  TurningRig rig(c.rig, seed);
  AttitudeFilter filter(rig.filter_parameters());
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<GyroStep>& steps = rig.advance();
    const bool silent = c.gyro_gap && frame % 50 < 2;
    Eigen::Quaterniond measured = rig.measured_attitude();
    if (frame > kSettling && frame % 100 < c.wrong_of)
      measured = rotation_exp({0, std::numbers::pi / 180, 0}) * measured;
    const bool seen = frame <= kSettling || frame % 100 >= c.gap_of;
    FilterUpdate update = FilterUpdate::kUsed;
    sums.times.push_back(microseconds([&] {
      for (const GyroStep& step : steps) {
        if (c.rig.gyro && !silent)
          filter.predict(step.interval_s, step.rate);
        else
          filter.predict(step.interval_s);
      }
      if (seen) update = filter.update(measured, rig.attitude_covariance());
    }));
    sums.refused += update == FilterUpdate::kRefused ? 1 : 0;
    sums.started += update == FilterUpdate::kStarted && frame > 0 ? 1 : 0;
    if (frame < kSettling) continue;
    const Vector6d error = filter_error(filter, rig, c.rig.gyro);
    const Matrix6d& covariance = filter.covariance();
    sums.attitude += error.head<3>().squaredNorm();
    sums.single += rig.attitude_covariance().trace();
    sums.drift += error.tail<3>().squaredNorm();
    sums.nees3 += error.head<3>().dot(covariance.topLeftCorner<3, 3>().inverse() * error.head<3>());
    sums.nees_drift += error.tail<3>().dot(covariance.bottomRightCorner<3, 3>().inverse() * error.tail<3>());
    sums.nees6 += error.dot(covariance.ldlt().solve(error));
    ++sums.samples;
  }
}

void run(const Case& c, int flights, int frames) {
  Sums sums;
  for (int flight = 0; flight < flights; ++flight)
    fly(c, frames, static_cast<std::uint64_t>(flight) + 1, sums);
  const double n = sums.samples;
  std::printf("%-46s %8.2f %8.2f %8.2f %10.3g %8.3f %8.3f %8.3f %8d %8d\n", c.name, quantile(sums.times, 0.5),
              std::sqrt(sums.single / n) / kArcsecond, std::sqrt(sums.attitude / n) / kArcsecond,
              std::sqrt(sums.drift / n), sums.nees3 / n, sums.nees_drift / n, sums.nees6 / n, sums.refused,
              sums.started);
}

}  // namespace

int bench_filter(Options& options) {
  int flights = 200;
  int frames = 400;
  options.add("--flights", flights, "of a row");
  options.add("--frames", frames, "frame sets of a flight");
  options.read();
  std::printf("%-46s %8s %8s %8s %10s %8s %8s %8s %8s %8s\n", "filter", "med us", "single\"", "filter\"",
              "rate rad/s", "NEES att", "NEES rt", "NEES all", "refused", "again");
  TurningRigOptions agile;
  TurningRigOptions calm;
  calm.acceleration_density = 1e-5;
  calm.first_rate_sigma = 0.002;
  TurningRigOptions slow = calm;
  slow.interval_s = 0.5;
  TurningRigOptions gyro = agile;
  gyro.gyro = true;
  gyro.gyro_steps = 10;
  const Case cases[] = {{"no gyro, 10 Hz, 1e-3 rad/s^1.5", agile},
                        {"no gyro, 10 Hz, 1e-5 rad/s^1.5", calm},
                        {"no gyro, 2 Hz, 1e-5 rad/s^1.5", slow},
                        {"no gyro, 1e-5, half the attitudes missing", calm, 50},
                        {"no gyro, 1e-5, 2 in 100 wrong by 1 deg", calm, 0, 2},
                        {"gyro 100 Hz, attitudes 10 Hz", gyro},
                        {"gyro, attitudes missing for 8 s of 10", gyro, 80},
                        {"gyro silent 4 frame sets in 100", gyro, 0, 0, true}};
  for (const Case& c : cases) run(c, flights, frames);
  return 0;
}

}  // namespace omma
