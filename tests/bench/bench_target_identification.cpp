// Target identification: share solved, wrong and left open, time, on clouds of dots with clutter and hidden
// targets (card_problem.hpp).
#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "components/tracker/target_identification.hpp"
#include "components/tracker/target_verification.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/card_problem.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

struct Tally {
  std::vector<double> times;
  int right = 0, wrong = 0, ambiguous = 0, open = 0;
  double foursomes = 0, hypotheses = 0, verified = 0;
  std::map<std::size_t, std::vector<double>>
      log_chances;  ///< of the truth left open, by dots of the body seen
};

/// ln of the expected number of chance matches as good as the true labelling of a cloud.
double true_log_chance(const CardProblem& problem, std::span<const TargetPair> truth) {
  const TargetIdentifierOptions options;
  TargetVerification verification(problem.body, options.gate, options.least_part);
  verification.start(problem.dots);
  TargetLabelling labelling;
  return verification.complete(problem.truth, truth, labelling) ? labelling.log_chance : 0;
}

void note_left_open(const CardProblem& problem, Tally& tally) {
  std::vector<TargetPair> truth;
  for (std::size_t i = 0; i < problem.dots.size(); ++i)
    if (problem.target_of_dot[i] >= 0)
      truth.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(problem.target_of_dot[i])});
  tally.log_chances[truth.size()].push_back(truth.size() < 4 ? 0 : true_log_chance(problem, truth));
}

void print_left_open(const Tally& tally) {
  for (const auto& [dots, log_chances] : tally.log_chances)
    std::printf(
        "    left open: %4zu with %zu dots of the body, of whose labelling chance makes e^%.1f to e^%.1f\n",
        log_chances.size(), dots, *std::min_element(log_chances.begin(), log_chances.end()),
        *std::max_element(log_chances.begin(), log_chances.end()));
}

/// Wrong: more than a quarter of the pairs are not the truth, or the pose is beyond 10 σ and not said to be
/// ambiguous. (A dot of clutter within the noise of where a hidden target would be cannot be told from it.)
bool is_right(const CardProblem& problem, const TargetIdentification& found) {
  std::size_t wrong = 0;
  for (const TargetPair& pair : found.pairs) wrong += problem.target_of_dot[pair.dot] != pair.target ? 1 : 0;
  if (4 * wrong > found.pairs.size()) return false;
  const Vector6d error = pose_error(found.pose.rig_from_body, problem.truth);
  return found.pose.ambiguous || error.dot(found.pose.covariance.inverse() * error) < 100;
}

void run(const char* name, const CardProblemOptions& options, int trials) {
  Tally tally;
  for (int trial = 0; trial < trials; ++trial) {
    const CardProblem problem = make_card_problem(options, static_cast<std::uint64_t>(trial));
    TargetIdentifier identifier(problem.body);
    TargetIdentification found;
    found = identifier.identify(problem.dots);
    tally.times.push_back(microseconds([&] { found = identifier.identify(problem.dots); }));
    tally.foursomes += found.foursomes;
    tally.hypotheses += found.hypotheses;
    tally.verified += found.verified;
    if (options.body_present && (found.status == TargetIdentificationStatus::kNoMatch ||
                                 found.status == TargetIdentificationStatus::kWorkLimit))
      note_left_open(problem, tally);
    if (found.status == TargetIdentificationStatus::kAmbiguous)
      ++tally.ambiguous;
    else if (found.status != TargetIdentificationStatus::kIdentified)
      ++tally.open;
    else if (options.body_present && is_right(problem, found))
      ++tally.right;
    else
      ++tally.wrong;
  }
  std::printf("%-44s %7.2f %6.2f %6.2f %6.2f %8.0f %8.0f %8.0f %7.1f %8.0f %6.1f\n", name,
              100.0 * tally.right / trials, 100.0 * tally.wrong / trials, 100.0 * tally.ambiguous / trials,
              100.0 * tally.open / trials, quantile(tally.times, 0.5), quantile(tally.times, 0.99),
              quantile(tally.times, 1.0), tally.foursomes / trials, tally.hypotheses / trials,
              tally.verified / trials);
  print_left_open(tally);
}

void table(const char* title, CardProblemOptions options, int trials) {
  std::printf("\n%-44s %7s %6s %6s %6s %8s %8s %8s %7s %8s %6s\n", title, "right%", "wrong%", "ambig%",
              "open%", "med us", "p99 us", "max us", "4somes", "poses", "verif");
  for (const int targets : {5, 8, 12, 25}) {
    for (const double hidden : {0.0, 0.3}) {
      for (const double clutter : {0.0, 0.25, 0.5}) {
        options.targets = targets;
        options.hidden = hidden;
        options.clutter = clutter;
        char name[80];
        std::snprintf(name, sizeof name, "%d targets, %.0f %% hidden, %.0f %% clutter", targets, 100 * hidden,
                      100 * clutter);
        run(name, options, trials);
      }
    }
  }
}

/// Clouds that do not hold the body: as many dots as its targets and as much clutter would have been.
void absent_rows(int trials) {
  CardProblemOptions problem;
  problem.clutter = 0.5;
  problem.body_present = false;
  std::printf("\n");
  const auto both_clouds = [&](const char* body) {
    for (const bool on_card : {false, true}) {
      problem.clutter_on_card = on_card;
      char name[80];
      std::snprintf(name, sizeof name, "%s, body absent, dots %s", body,
                    on_card ? "crowded" : "over the image");
      run(name, problem, trials);
    }
  };
  for (const int targets : {5, 8, 12, 25}) {
    problem.targets = targets;
    both_clouds((std::to_string(targets) + " targets").c_str());
  }
  problem.faces = true;
  problem.targets = 6;
  both_clouds("box, 6 LEDs a face");
}

}  // namespace

int bench_target_identification(Options& options) {
  int trials = 200;
  int absent = 0;
  options.add("--trials", trials, "clouds of a row");
  options.add("--absent", absent, "clouds without the body, instead of all else; 0: as many as trials", 0);
  options.read();
  if (absent > 0) {
    absent_rows(absent);
    return 0;
  }
  CardProblemOptions problem;
  table("card, clutter over the image", problem, trials);
  problem.clutter_on_card = true;
  table("card, clutter on the card", problem, trials);
  problem.clutter_on_card = false;
  problem.solid = true;
  table("solid body, clutter over the image", problem, trials);
  problem.solid = false;
  problem.faces = true;
  std::printf("\n");
  for (const int leds : {5, 6, 10}) {
    for (const double hidden : {0.0, 0.3}) {
      for (const double clutter : {0.0, 0.5}) {
        problem.targets = leds;
        problem.hidden = hidden;
        problem.clutter = clutter;
        char name[80];
        std::snprintf(name, sizeof name, "box, %d LEDs a face, %.0f %% hidden, %.0f %% clutter", leds,
                      100 * hidden, 100 * clutter);
        run(name, problem, trials);
      }
    }
  }
  absent_rows(trials);
  return 0;
}

}  // namespace omma
