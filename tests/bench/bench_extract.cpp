// The extractor on images whose truth is known: accuracy against the Cramér–Rao bound, honesty of its
// covariances, recall, false dots, and time beside a memcpy of the same image.
#include <cstdio>
#include <memory>

#include "components/extractor/dot_extractor.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/spot_scene.hpp"

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

void accuracy(const Kind& kind, int dots) {
  std::printf("\n%s; %d dots a row\n", kind.name, dots);
  std::printf("  %5s %5s  %7s %8s  %8s %8s %6s  %6s  %8s\n", "sigma", "SNR", "recall", "false", "rms px",
              "bound", "ratio", "NEES", "bias px");
  for (const double sigma : {0.7, 1.0, 1.5, 2.0, 2.5}) {
    for (const double snr : {5.0, 7.0, 10.0, 20.0, 50.0, 100.0}) {
      SpotScene scene;
      scene.background = kind.background;
      scene.noise = kind.noise;
      scene.gain = kind.gain;
      scene.white_level = kind.white_level;
      DotExtractor extractor(scene.width, scene.height);
      ExtractorParameters parameters;
      parameters.gain = static_cast<float>(kind.gain > 0 ? kind.gain : 1e6);
      auto list = std::make_unique<DotList>();
      std::mt19937_64 random(static_cast<std::uint64_t>(1000 * sigma + snr));
      SpotScore score;
      int images = 0;
      while (score.spots < dots) {
        scene.spots = grid_of_spots(scene, 40, sigma, snr, random);
        const Image image = render(scene, random);
        extractor.extract(image.view(), parameters, *list);
        score.add(scene, list->dots);
        ++images;
      }
      std::printf("  %5.2f %5.0f  %7.4f %8.2f  %8.4f %8.4f %6.3f  %6.2f  %8.4f\n", sigma, snr,
                  static_cast<double>(score.found) / score.spots,
                  static_cast<double>(score.false_dots) / images, score.rms(),
                  std::sqrt(score.squared_bound / (2 * std::max(1, score.found))), score.ratio(),
                  score.mean_nees(), score.largest_phase_bias());
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

}  // namespace

int bench_extract(int argc, char** argv) {
  if (const char* frames = text_option(argc, argv, "--frames", nullptr))
    return bench_extract_frames(frames, argc, argv);
  const int repeats = option(argc, argv, "--repeats", 301);
  const int dots = option(argc, argv, "--dots", 10000);
  std::printf("1024 x 768, 8 bits, one core\n  %-22s %8s %8s %9s %7s\n", "image", "med ms", "p95 ms",
              "memcpy ms", "ratio");

  time_of("empty", 0, 1.0, repeats);
  time_of("60 stars, 1 px", 60, 1.0, repeats);
  time_of("500 stars, 1 px", 500, 1.0, repeats);
  time_of("25 targets, 2 px", 25, 2.0, repeats);
  if (dots == 0) return 0;
  const int only = option(argc, argv, "--sensor", 0);
  for (int k = 1; const Kind& kind : kKinds)
    if (const int number = k++; only == 0 || only == number) accuracy(kind, dots);
  return 0;
}

}  // namespace omma
