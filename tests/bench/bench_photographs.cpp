// `omma-bench photographs`: `omma solve`'s solver on every photograph with known truth: solved or why not,
// error about each axis, stars, time. A wrong answer makes the exit code 1.
#include <cstdio>
#include <string>
#include <vector>

#include "ground/solve/photograph_solver.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/photographs.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

struct Count {
  int all = 0;
  int solved = 0;
  int wrong = 0;
};

void print_solution(const Photograph& photograph, const ground::PhotographSolution& solution,
                    const char* verdict) {
  if (!solution.solved) {
    std::printf("  %s\n", solution.reason.c_str());
    return;
  }
  const Eigen::Vector3d sigma = solution.attitude.covariance.diagonal().cwiseSqrt() * (180 * 3600 / M_PI);
  if (photograph.has_truth) {
    const Eigen::Vector3d error = error_arcsec(photograph, solution.attitude.rig_from_j2000);
    std::printf(" %7.1f %7.1f %8.1f", error.x(), error.y(), error.z());
  } else {
    std::printf(" %7s %7s %8s", "?", "?", "?");
  }
  std::printf(" %6.1f %6.1f %6.1f %6d %7.3f %6.0f%s\n", sigma.x(), sigma.y(), sigma.z(), solution.stars_used,
              solution.residual_rms_px, solution.log10_false_match, verdict);
}

Count run(const Photograph& photograph, int repeats) {
  std::vector<Image> images;
  std::vector<ImageView> views;
  images.reserve(photograph.images.size());
  views.reserve(photograph.images.size());
  for (const auto& file : photograph.images) images.push_back(read_image(file));
  for (const Image& image : images) views.push_back(image.view());
  ground::SolverOptions options;
  options.observer = photograph.observer;
  ground::PhotographSolver solver(photograph.rig, options);
  ground::PhotographSolution solution;
  std::vector<double> extract;
  std::vector<double> identify;
  std::vector<double> attitude;
  for (int i = 0; i < repeats; ++i) {
    solution = solver.solve(views);
    extract.push_back(solution.times.extract_ms);
    identify.push_back(solution.times.identify_ms);
    attitude.push_back(solution.times.attitude_ms);
  }
  Count count{1, solution.solved ? 1 : 0, 0};
  const char* verdict = "";
  if (solution.solved && photograph.has_truth) {
    const Eigen::Vector3d error = error_arcsec(photograph, solution.attitude.rig_from_j2000);
    const bool right = (error.array().abs() <= photograph.tolerance_arcsec.array()).all();
    count.wrong = right ? 0 : 1;
    if (!right) verdict = "  WRONG";
  } else if (solution.solved) {
    verdict = "  not known by others";
  }
  std::size_t dots = 0;
  for (const DotList& list : solver.dots().cameras) dots += list.dots.size();
  std::printf("  %-40s %4zu %8.2f %8.2f %8.2f", photograph.name.c_str(), dots, quantile(extract, 0.5),
              quantile(identify, 0.5), quantile(attitude, 0.5));
  print_solution(photograph, solution, verdict);
  return count;
}

}  // namespace

int bench_photographs(Options& options) {
  std::string data = OMMA_SHARED_DATA "/data";
  int repeats = 3;
  options.add("--data", data, "the shared data folder");
  options.add("--repeats", repeats, "of each time; the median is printed");
  options.read();
  std::printf("%-42s %4s %26s %24s %20s %6s %7s %6s\n", "", "", "median ms of", "error, arcsec, about",
              "1-sigma, arcsec", "stars", "rms", "false");
  std::printf("%-42s %4s %8s %8s %8s %7s %7s %8s %6s %6s %6s %6s %7s %6s\n", "photograph", "dots", "extract",
              "identify", "attitude", "x", "y", "z", "x", "y", "z", "used", "px", "log10");
  Count sum;
  for (const PhotographGroup group :
       {PhotographGroup::kLongyearbyen, PhotographGroup::kIndi, PhotographGroup::kRigs,
        PhotographGroup::kRigImages, PhotographGroup::kSingles, PhotographGroup::kClutter,
        PhotographGroup::kMediumField}) {
    Count count;
    std::printf("%s\n", name_of(group));
    for (const Photograph& photograph : photographs(data, group)) {
      const Count one = run(photograph, repeats);
      count.all += one.all;
      count.solved += one.solved;
      count.wrong += one.wrong;
    }
    std::printf("  %d of %d solved, %d wrong\n", count.solved, count.all, count.wrong);
    sum.all += count.all;
    sum.solved += count.solved;
    sum.wrong += count.wrong;
  }
  if (sum.all == 0) {
    std::fprintf(stderr, "%s: no folder `sky` with photographs (--data FOLDER)\n", data.c_str());
    return 2;
  }
  std::printf("all: %d of %d solved, %d wrong\n", sum.solved, sum.all, sum.wrong);
  return sum.wrong == 0 ? 0 : 1;
}

}  // namespace omma
