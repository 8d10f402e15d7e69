// Star identification, lost in space: solved, wrong, time, hypotheses over random attitudes, error over
// bound and NEES (3) of the right answers, and false answers in skies of false dots alone. A wrong answer
// makes the exit code 1.
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/sky_problem.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

constexpr std::size_t kPoor = 5;  // with fewer dots hardly any attitude can be proved

struct Case {
  const char* name;
  Rig rig;
  SkyProblemOptions options;
  double resolution_deg;  // stars closer than this are one dot
  double aided_deg = 0;   // the attitude is known to within this
};

// @return wrong answers
int run(const Case& c, int trials, const IdentificationParameters& parameters) {
  const auto catalogue =
      std::make_unique<StarCatalogue>(Observer{}, StarCatalogueParameters{6.5F, c.resolution_deg * kDegree});
  const auto identification =
      std::make_unique<StarIdentification>(*catalogue, sky_coverage(c.rig), parameters);
  const auto answer = std::make_unique<Identification>();
  std::mt19937_64 random(2010), aside(7);
  std::vector<double> times;
  std::vector<double> hypotheses;
  std::vector<double> dots;
  int right = 0;
  int wrong = 0;
  double squares = 0, bound = 0, nees = 0;  // of the right answers
  int poor = 0, poor_solved = 0;            // skies with fewer than five dots, and which of them were solved
  for (int trial = 0; trial < trials; ++trial) {
    const SkyProblem problem = random_sky(c.rig, catalogue->stars(), c.options, random);
    std::normal_distribution<double> gauss;
    const Eigen::Vector3d axis(gauss(aside), gauss(aside), gauss(aside));
    const Eigen::Quaterniond prior =
        rotation_exp(0.7 * c.aided_deg * kDegree * axis.normalized()) * problem.truth;
    times.push_back(microseconds([&] {
      const RealTimeScope scope;
      if (c.aided_deg > 0)
        identification->identify_near(prior, c.aided_deg * kDegree, problem.dots, *answer);
      else
        identification->identify(problem.dots, *answer);
    }));
    const SkyVerdict verdict = judge(problem, *answer);
    right += verdict == SkyVerdict::kRight ? 1 : 0;
    wrong += verdict == SkyVerdict::kWrong ? 1 : 0;
    if (verdict == SkyVerdict::kRight) {
      const Eigen::Vector3d error = rotation_log(problem.truth * answer->rig_from_j2000.conjugate());
      squares += error.squaredNorm();
      bound += answer->covariance.trace();
      nees += error.dot(answer->covariance.inverse() * error);
    }
    hypotheses.push_back(answer->hypotheses);
    dots.push_back(double(problem.dots.size()));
    poor += problem.dots.size() < kPoor ? 1 : 0;
    poor_solved += problem.dots.size() < kPoor && verdict == SkyVerdict::kRight ? 1 : 0;
  }
  std::printf("%-46s %6d %5.0f %5.0f %8.3f %6d %8.0f %8.0f %8.0f %8.0f %8.0f %7.3f %6.2f\n", c.name, trials,
              quantile(dots, 0.5), quantile(dots, 0.0), 100.0 * right / trials, wrong, quantile(times, 0.5),
              quantile(times, 0.99), quantile(times, 1.0), quantile(hypotheses, 0.5),
              quantile(hypotheses, 1.0), std::sqrt(squares / bound), nees / right);
  if (poor > 0)
    std::printf(
        "    skies with fewer than %zu dots: %.3f %% of all, %d of %d solved; of the others %.3f %%\n", kPoor,
        100.0 * poor / trials, poor_solved, poor, 100.0 * (right - poor_solved) / (trials - poor));
  std::fflush(stdout);
  return wrong;
}

struct NothingThere {
  const char* name;
  Rig rig;
  double resolution_deg;
  int least, most;  // dots over the sphere, or in the one camera
  double noise_px;  // to five times this
};

// @return answers, all of them wrong
int run_nothing_there(const NothingThere& c, int trials, const IdentificationParameters& parameters) {
  const auto catalogue =
      std::make_unique<StarCatalogue>(Observer{}, StarCatalogueParameters{6.5F, c.resolution_deg * kDegree});
  const auto identification =
      std::make_unique<StarIdentification>(*catalogue, sky_coverage(c.rig), parameters);
  const auto answer = std::make_unique<Identification>();
  std::mt19937_64 random(2010);
  std::vector<double> times;
  std::vector<double> hypotheses;
  int answers = 0;
  SkyProblemOptions options;
  options.stars_per_camera = 1;
  if (c.rig.cameras.size() == 1) options.magnitude_limit = 6.5F;
  for (int trial = 0; trial < trials; ++trial) {
    const int dots = c.least + static_cast<int>(random() % static_cast<unsigned>(c.most - c.least));
    (c.rig.cameras.size() == 1 ? options.false_dots : options.false_on_sphere) = dots;
    options.noise_px = c.noise_px * (1 + double(random() % 5));
    SkyProblem problem = random_sky(c.rig, catalogue->stars(), options, random);
    std::erase_if(problem.dots, [&](const RigDot& dot) { return problem.hr[dot.index] != 0; });
    times.push_back(microseconds([&] { identification->identify(problem.dots, *answer); }));
    answers += answer->status == IdentificationStatus::kIdentified ||
               answer->status == IdentificationStatus::kMirrored;
    hypotheses.push_back(answer->hypotheses);
  }
  std::printf("%-46s %6d answers %d; cpu us med %.0f max %.0f; hypotheses med %.0f max %.0f\n", c.name,
              trials, answers, quantile(times, 0.5), quantile(times, 1.0), quantile(hypotheses, 0.5),
              quantile(hypotheses, 1.0));
  std::fflush(stdout);
  return answers;
}

}  // namespace

int bench_identify(Options& options) {
  IdentificationParameters parameters;
  int trials = 200;
  int row = 0;
  int false_skies = 0;
  int bound = 7;
  auto limit = static_cast<int>(parameters.hypothesis_limit);
  options.add("--trials", trials, "attitudes of a row; 10000 for the full table");
  options.add("--row", row, "that one alone, by its number; 0: all", 0);
  options.add("--false-skies", false_skies, "skies of false dots alone; 0: as many as trials", 0);
  options.add("--limit", limit, "hypotheses tried of a sky");
  options.add("--bound", bound,
              "10 to the power of minus this: probability of a false match; with 1 or 2 some happen");
  options.read();
  std::printf("%-46s %6s %5s %5s %8s %6s %8s %8s %8s %8s %8s %7s %6s\n", "identify", "trials", "dots",
              "least", "solved%", "wrong", "cpu us", "p99", "max", "hyp med", "hyp max", "rms/bd", "NEES");
  const Rig three = equidistant_rig(3, 122);
  const Case cases[] = {
      {"3 x 122 deg, V<4.25, 0.1 px", three, {}, 0.25},
      {"3 x 122 deg, V<4.25, 0.5 px", three, {.noise_px = 0.5}, 0.25},
      {"3 x 122 deg, V<4.25, 0.2 px, lens 0.5 px off", three, {.noise_px = 0.2, .lens_error_px = 0.5}, 0.25},
      {"3 x 122 deg, 2 brightest each, 0.1 px", three, {.stars_per_camera = 2}, 0.25},
      {"3 x 122 deg, 5 brightest each, 0.3 px", three, {.noise_px = 0.3, .stars_per_camera = 5}, 0.25},
      {"1 x 60 deg, V<4.25, 0.2 px", equidistant_rig(1, 60), {.noise_px = 0.2}, 0.15},
      {"1 x 60 deg, V<5, 0.2 px", equidistant_rig(1, 60), {.magnitude_limit = 5.0F, .noise_px = 0.2}, 0.15},
      {"1 x 122 deg, V<4.25, 0.2 px", equidistant_rig(1, 122), {.noise_px = 0.2}, 0.25},
      {"1 x 187 deg, V<4.25, 0.2 px", equidistant_rig(1, 187), {.noise_px = 0.2}, 0.4},
      {"1 x 20 deg pinhole, V<6.5, 0.2 px",
       pinhole_rig(20),
       {.magnitude_limit = 6.5F, .noise_px = 0.2},
       0.04},
      {"1 x 10 deg pinhole, V<6.5, 0.2 px",
       pinhole_rig(10),
       {.magnitude_limit = 6.5F, .noise_px = 0.2},
       0.02},
      {"1 x 10 deg, known to 5 deg, V<6.5, 0.2 px",
       pinhole_rig(10),
       {.magnitude_limit = 6.5F, .noise_px = 0.2},
       0.02,
       5},
      {"3 x 122 deg, half the dots false, 0.2 px", three, {.noise_px = 0.2, .false_fraction = 0.5}, 0.25},
      {"3 x 122 deg, 300 false on the sphere, 0.2 px",
       three,
       {.noise_px = 0.2, .false_on_sphere = 300},
       0.25},
      {"1 x 122 deg, 300 false on the sphere, 0.2 px",
       equidistant_rig(1, 122),
       {.noise_px = 0.2, .false_on_sphere = 300},
       0.25},
      {"1 x 122 deg, half the dots false, 0.5 px",
       equidistant_rig(1, 122),
       {.noise_px = 0.5, .false_fraction = 0.5},
       0.25},
      {"1 x 122 deg, 20 false dots brighter than all stars",
       equidistant_rig(1, 122),
       {.noise_px = 0.2, .bright_false = 20},
       0.25},
      {"3 x 122 deg, 80 % of the dots false, 0.2 px", three, {.noise_px = 0.2, .false_fraction = 0.8}, 0.25},
  };
  parameters.hypothesis_limit = static_cast<std::uint32_t>(limit);
  parameters.false_match_probability = std::pow(10.0, -bound);
  int number = 0;
  int wrong = 0;
  for (const Case& c : cases) {
    if (++number == row || row == 0) wrong += run(c, trials, parameters);
  }
  const NothingThere skies[] = {
      {"5 to 300 false dots alone, 0.1 to 0.5 px", three, 0.25, 5, 305, 0.1},
      {"1 x 10 deg, 4 to 8 false dots, 0.1 to 0.5 px", pinhole_rig(10), 0.02, 4, 9, 0.1},
      {"1 x 60 deg, 4 to 8 false dots, 0.1 to 0.5 px", equidistant_rig(1, 60), 0.15, 4, 9, 0.1},
  };
  for (const NothingThere& sky : skies) {
    if (++number == row || row == 0)
      wrong += run_nothing_there(sky, false_skies > 0 ? false_skies : trials, parameters);
  }
  const std::uint64_t allocations = memory_guard::violations().total();
  std::printf("allocations while identifying: %llu%s\n", static_cast<unsigned long long>(allocations),
              memory_guard::installed() ? "" : " (not watched)");
  return wrong == 0 ? 0 : 1;
}

}  // namespace omma
