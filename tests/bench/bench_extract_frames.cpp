// The extractor on rendered frames with truth: every dot beside the true spots, stars and targets apart, by
// signal-to-noise ratio and by how near the next true spot is.
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "components/extractor/dot_extractor.hpp"
#include "fsw/app/mission.hpp"
#include "ground/report/truth.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/bench/bench_extract_frames.hpp"
#include "tests/bench/measure.hpp"

namespace omma {
namespace {

struct Row {
  int spots = 0, found = 0;
  double squared_error = 0, squared_bound = 0, nees = 0;
};

const char* snr_class(double snr) {
  return snr < 7 ? "5-7" : snr < 10 ? "7-10" : snr < 20 ? "10-20" : snr < 50 ? "20-50" : "50+";
}

}  // namespace

int bench_extract_frames(const RenderedFrames& rendered) {
  const std::filesystem::path frames = rendered.folder;
  const Mission mission = read_mission(rendered.mission);
  const auto truth = ground::read_truth(frames / "truth.jsonl", static_cast<int>(mission.cameras.size()));
  std::map<std::string, Row> rows;
  int false_dots = 0, images = 0;
  std::vector<double> times;
  for (const ground::TruthFrame& frame : truth) {
    if (frame.frame % static_cast<std::uint64_t>(rendered.every) != 0) continue;
    for (std::size_t c = 0; c < mission.cameras.size(); ++c) {
      const std::string name(mission.rig.cameras[c].name.view());
      char file[64];
      std::snprintf(file, sizeof file, "_%06d.png", static_cast<int>(frame.frame));
      const Image image = read_image(frames / name / (name + file));
      DotExtractor extractor(image.width, image.height);
      auto list = std::make_unique<DotList>();
      ImageView view = image.view();
      view.white_level = static_cast<std::uint16_t>((1 << mission.cameras[c].bits) - 1);
      times.push_back(
          microseconds([&] { extractor.extract(view, mission.cameras[c].dots.parameters, *list); }));
      ++images;
      std::vector<bool> used(list->dots.size(), false);
      for (const ground::TruthSpot& spot : frame.spots) {
        if (spot.camera != static_cast<int>(c) || spot.snr < 5 || spot.kind == ground::TruthSpot::Kind::kMoon)
          continue;
        double next = 1e9;
        for (const ground::TruthSpot& other : frame.spots) {
          if (other.camera == spot.camera && &other != &spot && other.snr > 0.2 * spot.snr)
            next = std::min(next, (other.pixel - spot.pixel).norm());
        }
        std::size_t nearest = list->dots.size();
        double least = 3;
        for (std::size_t i = 0; i < list->dots.size(); ++i) {
          const double distance = (list->dots[i].pixel - spot.pixel).norm();
          if (!used[i] && distance < least) {
            nearest = i;
            least = distance;
          }
        }
        const bool target = spot.kind == ground::TruthSpot::Kind::kTarget;
        Row* of[2] = {
            &rows[std::string(target ? "target " : "star   ") + name + " SNR " + snr_class(spot.snr)],
            &rows[std::string(target ? "target " : "star   ") + "next spot " +
                  (next < 3   ? "<3"
                   : next < 5 ? "3-5"
                   : next < 8 ? "5-8"
                              : ">8") +
                  " px"]};
        const bool found = nearest < list->dots.size();
        if (found) used[nearest] = true;
        for (Row* row : of) {
          ++row->spots;
          if (!found) continue;
          const Dot& dot = list->dots[nearest];
          const Eigen::Vector2d error = dot.pixel - spot.pixel;
          ++row->found;
          row->squared_error += error.squaredNorm();
          row->squared_bound += spot.information.inverse().trace();
          row->nees += error.dot(dot.covariance.inverse() * error);
        }
        if (rendered.shown == static_cast<int>(frame.frame) && target) {
          std::printf("%s %s snr %.1f at %.2f %.2f next %.1f: ", name.c_str(), spot.id.c_str(), spot.snr,
                      spot.pixel.x(), spot.pixel.y(), next);
          if (!found) {
            std::printf("missed\n");
            continue;
          }
          const Dot& dot = list->dots[nearest];
          const Eigen::Vector2d error = dot.pixel - spot.pixel;
          std::printf("error %.3f %.3f sigma %.3f bound %.3f, width %.2f x %.2f, snr %.1f area %d\n",
                      error.x(), error.y(), std::sqrt(dot.covariance(0, 0)),
                      std::sqrt(1 / spot.information(0, 0)), dot.sigma_major, dot.sigma_minor, dot.snr,
                      dot.area);
        }
      }
      for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i]) continue;
        bool faint = false;
        for (const ground::TruthSpot& spot : frame.spots)
          faint = faint ||
                  (spot.camera == static_cast<int>(c) && (spot.pixel - list->dots[i].pixel).norm() < 2.5);
        if (!faint) ++false_dots;
      }
    }
  }
  std::printf("%-28s %6s %7s %8s %8s %7s %7s\n", "spots", "number", "found", "rms px", "bound", "ratio",
              "NEES");
  for (const auto& [name, row] : rows) {
    const int n = std::max(1, row.found);
    std::printf("%-28s %6d %7.4f %8.4f %8.4f %7.3f %7.2f\n", name.c_str(), row.spots,
                static_cast<double>(row.found) / row.spots, std::sqrt(row.squared_error / (2 * n)),
                std::sqrt(row.squared_bound / (2 * n)), std::sqrt(row.squared_error / row.squared_bound),
                row.nees / n);
  }
  std::printf("dots where nothing was drawn: %.2f an image; median %.2f ms\n",
              static_cast<double>(false_dots) / std::max(1, images), 1e-3 * quantile(times, 0.5));
  return 0;
}

}  // namespace omma
