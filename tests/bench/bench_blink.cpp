// omma-bench blink: lights told apart by their blinking codes: identities right, wrong and open against the
// number of frames seen, time a frame.
#include <cstdio>
#include <memory>

#include "components/tracker/blink_tracks.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/blink_problem.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

struct Case {
  const char* name;
  BlinkProblemOptions options;
};

void run(const Case& c, const BlinkDecoder& decoder, int frames, int trials) {
  int right = 0, wrong = 0, open = 0;
  std::vector<double> times;
  const auto tracks = std::make_unique<BlinkTracks>();
  std::array<BlinkHistory, BlinkTracks::kCapacity> histories;
  std::array<BlinkIdentity, BlinkTracks::kCapacity> identities;
  for (int trial = 0; trial < trials; ++trial) {
    *tracks = BlinkTracks();
    BlinkScene scene(decoder.codes(), c.options, static_cast<std::uint64_t>(trial) + 1);
    BlinkFrame frame;
    for (int i = 0; i < frames; ++i) {
      frame = scene.next();
      times.push_back(microseconds([&] {
        const RealTimeScope scope;
        tracks->step(frame.number, frame.dots);
        std::size_t count = 0;
        for (const BlinkTrack& track : tracks->tracks()) histories[count++] = track.history;
        if (i + 1 == frames) decoder.decode({histories.data(), count}, identities);
      }));
    }
    for (std::size_t t = 0; t < tracks->tracks().size(); ++t) {
      const BlinkTrack& track = tracks->tracks()[t];
      if (track.dot < 0) continue;
      const int truth = frame.light[static_cast<std::size_t>(track.dot)];
      if (identities[t].code < 0) {
        open += truth >= 0 ? 1 : 0;
      } else if (identities[t].code == truth) {
        ++right;
      } else {
        ++wrong;
      }
    }
  }
  std::printf("%-44s %6d %8.2f%% %8.3f%% %8.2f%% %9.1f %9.1f\n", c.name, frames,
              100.0 * right / std::max(1, right + wrong + open),
              100.0 * wrong / std::max(1, right + wrong + open),
              100.0 * open / std::max(1, right + wrong + open), quantile(times, 0.5), quantile(times, 1.0));
}

}  // namespace

int bench_blink(Options& options) {
  int trials = 200;
  options.add("--trials", trials, "scenes of a row");
  options.read();
  const BlinkDecoder decoder(make_blink_codes(16, 20, 4));
  std::printf("%zu codes of %d bits\n", decoder.codes().words.size(), decoder.codes().length);
  std::printf("%-44s %6s %9s %9s %9s %9s %9s\n", "lights lit in the last frame", "frames", "right", "wrong",
              "open", "med us", "max us");
  BlinkProblemOptions clean;
  clean.lost_frames = clean.missed = clean.clutter = 0;
  BlinkProblemOptions rough;
  rough.lost_frames = 0.2;
  rough.missed = 0.05;
  rough.clutter = 10;
  BlinkProblemOptions fast;
  fast.speed_px = 6;
  const Case cases[] = {{"nothing lost", clean},
                        {"5 % of frames lost, 2 % missed, 2 false", {}},
                        {"20 % of frames lost, 5 % missed, 10 false", rough},
                        {"6 px a frame", fast}};
  for (const Case& c : cases)
    for (const int frames : {10, 20, 30, 60}) run(c, decoder, frames, trials);
  print_memory_touched();
  return 0;
}

}  // namespace omma
