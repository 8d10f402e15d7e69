// Judges a flight whose frames came through video devices: `omma-hil-judge RECORDING FRAMES FED.csv MISSION`.
// Each frame set of the recording is the fed one of its time (what `omma feed --log` wrote); then attitude
// and poses are held to the simulator's truth as `omma report` does. Exit code 0 where no frame was lost and
// all is right.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "ground/report/evaluation.hpp"

namespace {

using namespace omma;
using namespace omma::ground;

constexpr double kArcsec = 3600 * 180 / M_PI;
constexpr std::int64_t kNearNs = 50'000'000;  // half of a period at 10 Hz

struct Fed {
  std::uint64_t frame = 0;
  std::int64_t time_ns = 0;
};

std::vector<Fed> read_fed(const std::string& file) {
  std::ifstream in(file);
  std::string head;
  std::getline(in, head);
  std::vector<Fed> fed;
  char comma = 0;
  for (Fed one; in >> one.frame >> comma >> one.time_ns;) fed.push_back(one);
  if (fed.size() < 2) throw InputError(file, 0, "frames", "frames that were fed", "none");
  return fed;
}

// The flight's number of each frame set becomes the fed one's; what has none is left out.
class Renumbering {
 public:
  Renumbering(const std::vector<Fed>& fed, const FlightLog& log) {
    for (const LoggedFrameSet& set : log.frame_sets) {
      const auto after =
          std::lower_bound(fed.begin(), fed.end(), set.time_ns - kNearNs,
                           [](const Fed& one, std::int64_t time) { return one.time_ns < time; });
      if (after != fed.end() && after->time_ns <= set.time_ns + kNearNs) fed_of_[set.frame] = after->frame;
    }
  }
  const std::map<std::uint64_t, std::uint64_t>& all() const { return fed_of_; }
  template <class Samples>
  void apply(Samples& samples) const {
    std::erase_if(samples, [&](const auto& sample) { return !fed_of_.contains(sample.frame); });
    for (auto& sample : samples) sample.frame = fed_of_.at(sample.frame);
  }

 private:
  std::map<std::uint64_t, std::uint64_t> fed_of_;
};

/// Numbers missing between the first and the last, and numbers that came twice.
std::size_t lost_or_doubled(const Renumbering& numbers) {
  std::size_t wrong = 0;
  std::uint64_t last = numbers.all().begin()->second;
  for (auto at = std::next(numbers.all().begin()); at != numbers.all().end(); ++at) {
    wrong += at->second > last ? at->second - last - 1 : 1;
    last = at->second;
  }
  return wrong;
}

// The first frame set fires the cameras, whose frames the second one collects.
void leave_out_what_fired_first(FlightLog& log) {
  const bool blind = !log.frame_sets.empty() &&
                     std::all_of(log.frame_sets[0].cameras.begin(), log.frame_sets[0].cameras.end(),
                                 [](const auto& camera) { return camera.dots_found == 0; });
  if (blind) log.frame_sets.erase(log.frame_sets.begin());
}

std::size_t without_a_camera(const FlightLog& log) {
  return static_cast<std::size_t>(
      std::count_if(log.frame_sets.begin(), log.frame_sets.end(), [](const auto& set) {
        return std::any_of(set.cameras.begin(), set.cameras.end(),
                           [](const auto& camera) { return camera.dots_found == 0; });
      }));
}

bool judge(const std::string& recording, const std::filesystem::path& frames, const std::string& fed_file,
           const std::string& mission_file) {
  const FlownMission mission = read_flown_mission(mission_file);
  std::vector<TruthFrame> truth =
      read_truth(frames / "truth.jsonl", static_cast<int>(mission.rig.cameras.size()));
  FlightLog log = read_flight_log(recording);
  leave_out_what_fired_first(log);
  const std::vector<Fed> fed = read_fed(fed_file);
  const Renumbering numbers(fed, log);
  if (numbers.all().size() < 2)
    throw InputError(recording, 0, "frame sets", "some at the time of fed ones", "none");
  const std::size_t sets = log.frame_sets.size();
  const std::size_t strangers = sets - numbers.all().size();
  const std::size_t wrong = lost_or_doubled(numbers);
  const std::size_t blind = without_a_camera(log);
  const std::uint64_t first = numbers.all().begin()->second;
  const std::uint64_t last = numbers.all().rbegin()->second;
  std::printf(
      "%zu frame sets flown: fed frames %llu to %llu; %zu lost or doubled, %zu of no fed frame, %zu without "
      "the dots of a camera\n",
      sets, static_cast<unsigned long long>(first), static_cast<unsigned long long>(last), wrong, strangers,
      blind);
  numbers.apply(log.frame_sets);
  numbers.apply(log.attitudes);
  numbers.apply(log.poses);
  log.dots.clear();
  std::erase_if(truth, [&](const TruthFrame& frame) { return frame.frame < first || frame.frame > last; });

  const Evaluation result = evaluate(mission, truth, log, recording);
  const double attitude = result.attitude.rms.norm();
  std::printf("attitude: %zu of %zu solved, error %.1f arcsec rms, 3 axes (smallest possible %.1f)\n",
              result.attitude.points.size(), truth.size(), attitude * kArcsec,
              result.attitude.bound_rms.norm() * kArcsec);
  bool right = result.attitude.points.size() + 1 >= truth.size() && attitude * kArcsec < 120;
  for (const PoseEvaluation& pose : result.poses) {
    const double millimetres = 1e3 * pose.rms.tail<3>().norm();
    std::printf("pose of %s: %zu of %zu solved, error %.2f mm and %.1f arcsec rms, %.2f to %.2f m away\n",
                pose.body.c_str(), pose.points.size(), pose.frames, millimetres,
                pose.rms.head<3>().norm() * kArcsec, pose.first_range, pose.last_range);
    right = right && pose.points.size() + 1 >= pose.frames && millimetres < 20;
  }
  return right && wrong == 0 && strangers == 0 && blind == 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: omma-hil-judge RECORDING FRAMES FED.csv MISSION\n", stderr);
    return 2;
  }
  try {
    return judge(argv[1], argv[2], argv[3], argv[4]) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "omma-hil-judge: %s\n", error.what());
    return 2;
  }
}
