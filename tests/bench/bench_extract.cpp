// The extractor on images whose truth is known: accuracy against the Cramér–Rao bound, honesty of its
// covariances, recall, false dots, and time beside a memcpy of the same image.
#include <cstdio>
#include <memory>

#include "components/extractor/dot_extractor.hpp"
#include "tests/bench/bench_extract_frames.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/photograph_stars.hpp"
#include "tests/bench/spot_scene.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

struct Kind {
  const char* name;
  double background, noise, gain;
  int white_level;
};

// Sensors of the accuracy tables.
constexpr Kind kKinds[] = {
    {"8 bits, background noise of 2 grey levels", 20, 2.0, 0, 255},
    {"8 bits, noise of 1 grey level, 40 electrons a grey level", 12, 1.0, 40, 255},
    {"12 bits, noise of 3 grey levels, 2 electrons a grey level", 70, 3.0, 2, 4095},
};

constexpr double kMixed = 0;  // signal-to-noise ratios of 6 to 100, evenly spread in the logarithm

SpotScore score_of(const Kind& kind, double sigma, double snr, int dots, std::mt19937_64& random,
                   int& images) {
  SpotScene scene;
  scene.background = kind.background;
  scene.noise = kind.noise;
  scene.gain = kind.gain;
  scene.white_level = kind.white_level;
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = static_cast<float>(kind.gain > 0 ? kind.gain : 1e6);
  auto list = std::make_unique<DotList>();
  std::uniform_real_distribution<double> logarithm(std::log(6.0), std::log(100.0));
  SpotScore score;
  for (images = 0; score.spots < dots; ++images) {
    scene.spots = grid_of_spots(scene, 40, sigma, snr, random);
    for (MadeSpot& spot : scene.spots)
      if (snr == kMixed) spot.snr = std::exp(logarithm(random));
    const Image image = render(scene, random);
    extractor.extract(image.view(), parameters, *list);
    score.add(scene, list->dots);
  }
  return score;
}

void accuracy(const Kind& kind, int dots) {
  std::printf("\n%s; %d dots a row\n", kind.name, dots);
  std::printf("  %5s %5s  %7s %8s  %8s %8s %6s  %6s  %8s\n", "sigma", "SNR", "recall", "false", "rms px",
              "bound", "ratio", "NEES", "bias px");
  SpotScore all;
  double worst_ratio = 0, worst_bias = 0;
  for (const double sigma : {0.7, 1.0, 1.5, 2.0, 2.5}) {
    for (const double snr : {5.0, 7.0, 10.0, 20.0, 50.0, 100.0, kMixed}) {
      std::mt19937_64 random(static_cast<std::uint64_t>(1000 * sigma + snr));
      int images = 0;
      const SpotScore score = score_of(kind, sigma, snr, dots, random, images);
      char name[8];
      std::snprintf(name, sizeof name, "%.0f", snr);
      std::printf("  %5.2f %5s  %7.4f %8.2f  %8.4f %8.4f %6.3f  %6.2f  %8.4f\n", sigma,
                  snr > 0 ? name : "mixed", static_cast<double>(score.found) / score.spots,
                  static_cast<double>(score.false_dots) / images, score.rms(),
                  std::sqrt(score.squared_bound / (2 * std::max(1, score.found))), score.ratio(),
                  score.mean_nees(), score.largest_phase_bias());
      if (snr > 10) {
        worst_ratio = std::max(worst_ratio, score.ratio());
        worst_bias = std::max(worst_bias, score.largest_phase_bias());
      }
      if (snr == kMixed) {
        all.found += score.found;
        all.nees += score.nees;
      }
    }
  }
  std::printf(
      "  rows above SNR 10: largest error over bound %.3f (asked: 1.1), largest bias with the pixel's phase "
      "%.4f px "
      "(asked: 0.02)\n  mean NEES of the mixed rows: %.3f over %d dots (asked: 1.9 to 2.1)\n",
      worst_ratio, worst_bias, all.mean_nees(), all.found);
}

// Stars drawn out by the camera's motion.
void trails(int dots) {
  std::printf(
      "\ntrails, 8 bits, background noise of 2 grey levels, spots of 0.8 px\n  %6s %5s  %7s %8s  %8s %8s %6s "
      " %6s\n",
      "length", "SNR", "recall", "false", "rms px", "bound", "ratio", "NEES");
  for (const double length : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    for (const double snr : {15.0, 40.0}) {
      SpotScene scene;
      DotExtractor extractor(scene.width, scene.height);
      ExtractorParameters parameters;
      parameters.gain = 1e6F;
      auto list = std::make_unique<DotList>();
      std::mt19937_64 random(static_cast<std::uint64_t>(100 * length + snr));
      SpotScore score;
      int images = 0;
      for (; score.spots < dots; ++images) {
        scene.spots = grid_of_spots(scene, 48, 0.8, snr, random);
        for (MadeSpot& spot : scene.spots) spot.trail = length * Eigen::Vector2d(0.8, 0.6);
        const Image image = render(scene, random);
        extractor.extract(image.view(), parameters, *list);
        score.add(scene, list->dots);
      }
      std::printf("  %6.0f %5.0f  %7.4f %8.2f  %8.4f %8.4f %6.3f  %6.2f\n", length, snr,
                  static_cast<double>(score.found) / score.spots,
                  static_cast<double>(score.false_dots) / images, score.rms(),
                  std::sqrt(score.squared_bound / (2 * std::max(1, score.found))), score.ratio(),
                  score.mean_nees());
    }
  }
}

void time_of(const char* name, int count, double sigma, int repeats) {
  SpotScene scene;
  std::mt19937_64 random(7);
  scene.background = 12;
  scene.noise = 1.5;
  scene.spots = scattered_spots(scene, count, 14, sigma, 30, random);
  const Image image = render(scene, random);
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = 1e6F;  // the scene's noise is the background's alone
  auto list = std::make_unique<DotList>();
  std::vector<std::byte> copy(image.pixels.size());
  std::vector<double> extraction, copying;
  for (int k = 0; k < repeats; ++k) {
    copying.push_back(microseconds([&] { std::memcpy(copy.data(), image.pixels.data(), copy.size()); }));
    extraction.push_back(microseconds([&] { extractor.extract(image.view(), parameters, *list); }));
  }
  SpotScore score;
  score.add(scene, list->dots);
  const double median = quantile(extraction, 0.5);
  const double memcpy_us = quantile(copying, 0.5);
  std::printf("  %-22s %8.3f %8.3f %9.3f %7.1f  %4d of %d, %d false, rms %.4f px (%.3f x bound, NEES %.2f)\n",
              name, 1e-3 * median, 1e-3 * quantile(extraction, 0.95), 1e-3 * memcpy_us, median / memcpy_us,
              score.found, score.spots, score.false_dots, score.rms(), score.ratio(), score.mean_nees());
}

// The same image in windows about its spots, as the look-out gives them, and whole: in turn, so that the
// ratio is of one machine in one state.
void time_in_windows(int count, int repeats) {
  SpotScene scene;
  std::mt19937_64 random(7);
  scene.background = 12;
  scene.noise = 1.5;
  scene.spots = scattered_spots(scene, count, 14, 1.0, 30, random);
  const Image image = render(scene, random);
  std::vector<SearchWindow> windows;
  for (const MadeSpot& spot : scene.spots) {
    constexpr int kHalf = 10;
    const int u = static_cast<int>(spot.pixel.x());
    const int v = static_cast<int>(spot.pixel.y());
    windows.push_back({u - kHalf, v - kHalf, u + kHalf, v + kHalf});
  }
  WindowTiles tiles(scene.width, scene.height);
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = 1e6F;
  auto list = std::make_unique<DotList>();
  std::vector<double> whole, in_windows;
  for (int k = 0; k < repeats; ++k) {
    whole.push_back(microseconds([&] { extractor.extract(image.view(), parameters, *list); }));
    in_windows.push_back(microseconds([&] {
      tiles.set(windows);
      extractor.extract(image.view(), parameters, {}, *list, &tiles);
    }));
  }
  SpotScore score;
  score.add(scene, list->dots);
  std::printf("  %d stars in windows: %.3f ms, %.2f of the whole image's; %d of %d, %d false\n", count,
              1e-3 * quantile(in_windows, 0.5), quantile(in_windows, 0.5) / quantile(whole, 0.5), score.found,
              score.spots, score.false_dots);
}

// Where the time goes: each stage by itself on the image of 500 stars.
void time_of_stages(int repeats) {
  SpotScene scene;
  std::mt19937_64 random(7);
  scene.background = 12;
  scene.noise = 1.5;
  scene.spots = scattered_spots(scene, 500, 14, 1, 30, random);
  const Image image = render(scene, random);
  const ImageView view = image.view();
  ExtractorParameters parameters;
  parameters.gain = 1e6F;
  BackgroundMap background(view.width, view.height);
  DetectionFilter filter(view.width, view.height);
  CandidateSearch search(view.width, view.height);
  DotMeasurement measurement(view.width, view.height, 4096);
  std::vector<Candidate> candidates;
  std::vector<Dot> dots;
  candidates.reserve(4096);
  dots.reserve(4096);
  std::vector<double> mapping, filtering, searching, measuring;
  for (int k = 0; k < repeats; ++k) {
    mapping.push_back(microseconds([&] { background.build(view, false); }));
    filtering.push_back(microseconds([&] {
      filter.start(view, false, background, parameters.threshold);
      for (int v = 1; v < view.height - 1; ++v) filter.row(v);
    }));
    candidates.clear();
    dots.clear();
    searching.push_back(
        microseconds([&] { search.find(view, false, parameters, nullptr, nullptr, candidates); }));
    measuring.push_back(microseconds([&] {
      measurement.start(view, false, parameters, {}, candidates);
      measurement.measure(candidates, dots);
    }));
  }
  const double map_us = quantile(mapping, 0.5), filter_us = quantile(filtering, 0.5);
  std::printf(
      "  of 500 stars: background %.3f, detection filter %.3f, components and peaks %.3f, measurement %.3f "
      "ms\n",
      1e-3 * map_us, 1e-3 * filter_us, 1e-3 * (quantile(searching, 0.5) - map_us - filter_us),
      1e-3 * quantile(measuring, 0.5));
}

void real_photograph() {
  const auto all = photographs(OMMA_SHARED_DATA "/data", PhotographGroup::kLongyearbyen);
  if (all.empty()) {
    std::printf("\nphotograph of Longyearbyen: not in the shared data folder\n");
    return;
  }
  const Photograph& photograph = all[0];
  const Image image = read_image(photograph.images[0]);
  DotExtractor extractor(image.width, image.height);
  auto list = std::make_unique<DotList>();
  extractor.extract(image.view(), ExtractorParameters{}, *list);
  const PhotographStars stars = stars_found(photograph, list->dots);
  float least = 1e9F;
  for (const Dot& dot : list->dots) least = std::min(least, dot.snr);
  std::printf(
      "\nphotograph of Longyearbyen: %d of %d listed stars to V 4.5 found (recall %.3f; the list of dots is "
      "full, its "
      "faintest has SNR %.1f, %u more candidates);\n  of the %d brightest dots %d are stars of the catalogue "
      "(precision %.3f); of all %zu dots %d\n",
      stars.found, stars.listed, static_cast<double>(stars.found) / stars.listed, static_cast<double>(least),
      list->dropped, stars.brightest, stars.brightest_are_stars,
      static_cast<double>(stars.brightest_are_stars) / stars.brightest, list->dots.size(), stars.are_stars);
  // What measures light in another way would have kept: the list is what limits, not the search.
  std::vector<Candidate> candidates;
  candidates.reserve(16384);
  CandidateSearch search(image.width, image.height);
  search.find(image.view(), false, ExtractorParameters{}, nullptr, nullptr, candidates);
  std::vector<Dot> places(candidates.size());
  std::sort(candidates.begin(), candidates.end(), brighter);
  for (std::size_t i = 0; i < candidates.size(); ++i) places[i].pixel = {candidates[i].u, candidates[i].v};
  const auto found_in = [&](std::size_t most) {
    return stars_found(photograph, std::span(places).first(std::min(most, places.size()))).found;
  };
  std::printf("  of the listed stars, %d are among the %zu candidates, %d among the %zu of most light\n",
              found_in(places.size()), places.size(), found_in(limits::kDotsPerCamera),
              limits::kDotsPerCamera);
}

}  // namespace

int bench_extract(Options& options) {
  int repeats = 301;
  int dots = 10000;
  int only = 0;
  RenderedFrames rendered;
  options.add("--repeats", repeats, "of each time");
  options.add("--dots", dots, "of each row of accuracy; 0: times alone", 0);
  options.add("--sensor", only, "one row of accuracy only, by its number; 0: all", 0);
  options.add("--frames", rendered.folder, "rendered frames with truth, instead of all else");
  options.add("--mission", rendered.mission, "with --frames: how they are flown");
  options.add("--every", rendered.every, "with --frames: one frame of so many");
  options.add("--show", rendered.shown, "with --frames: the frame whose missed spots are listed", -1);
  options.read();
  if (!rendered.folder.empty()) return bench_extract_frames(rendered);
  std::printf("1024 x 768, 8 bits, one core\n  %-22s %8s %8s %9s %7s\n", "image", "med ms", "p95 ms",
              "memcpy ms", "ratio");
  time_of("empty", 0, 1.0, repeats);
  time_of("60 stars, 1 px", 60, 1.0, repeats);
  time_of("500 stars, 1 px", 500, 1.0, repeats);
  time_of("25 targets, 2 px", 25, 2.0, repeats);
  time_of_stages(repeats);
  time_in_windows(20, repeats);
  time_in_windows(60, repeats);
  real_photograph();
  if (dots == 0) return 0;
  trails(std::min(dots, 2000));
  for (int k = 1; const Kind& kind : kKinds)
    if (const int number = k++; only == 0 || only == number) accuracy(kind, dots);
  return 0;
}

}  // namespace omma
