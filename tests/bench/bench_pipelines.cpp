// The extraction pipelines side by side on the same rendered frames with truth: star frames, frames with the
// card, frames with the Moon.
#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "components/extractor/camera_dots.hpp"
#include "fsw/app/mission.hpp"
#include "ground/report/truth.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/pipeline_picture.hpp"

namespace omma {
namespace {

constexpr double kNear = 1.5;            // a dot this near to a true spot is it [px]
constexpr double kStarDeviations = 3.5;  // with 2.5 false dots outnumber the stars
constexpr double kCounts = 7;            // signal-to-noise ratio from which a missed spot is counted

struct ShownFrame {
  Image image;
  std::uint16_t white_level;
  ExtractorParameters parameters;
  std::vector<ground::TruthSpot> spots;
};

struct Row {
  int images = 0, found = 0, missed = 0, false_dots = 0;
  double squared_error = 0, nees = 0;
  std::vector<double> times;
};

// As they fly: the camera's own parameters, the scratch made once and in the caches.
class Algorithm {
 public:
  Algorithm(const char* name, ExtractorAlgorithm algorithm) : name_(name), algorithm_(algorithm) {}
  const char* name() const { return name_; }

  const DotList& find(const ShownFrame& frame, double& us) {
    ImageView view = frame.image.view();
    view.white_level = frame.white_level;
    ExtractorCamera camera;
    camera.width = view.width;
    camera.height = view.height;
    camera.parameters = frame.parameters;
    camera.parameters.algorithm = algorithm_;
    if (algorithm_ == ExtractorAlgorithm::kStars) camera.parameters.classical.deviations = kStarDeviations;
    CameraDots dots(camera);
    dots.find(view, *list_);
    us = microseconds([&] { dots.find(view, *list_); });
    return *list_;
  }

 private:
  const char* name_;
  ExtractorAlgorithm algorithm_;
  std::unique_ptr<DotList> list_ = std::make_unique<DotList>();
};

// Adds to the row, and to `marked` what became of each place.
void judge(const ShownFrame& frame, Algorithm& algorithm, Row& row, std::vector<MarkedPlace>& marked) {
  double us = 0;
  const auto& places = algorithm.find(frame, us).dots;
  row.times.push_back(us);
  ++row.images;
  std::vector<bool> used(places.size(), false);
  for (const ground::TruthSpot& spot : frame.spots) {
    std::size_t nearest = places.size();
    double least = kNear;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double distance = (places[i].pixel - spot.pixel).norm();
      if (used[i] || distance >= least) continue;
      nearest = i;
      least = distance;
    }
    if (nearest < places.size()) used[nearest] = true;
    if (spot.snr < kCounts || spot.kind == ground::TruthSpot::Kind::kMoon) continue;
    if (nearest < places.size()) {
      ++row.found;
      marked.push_back({places[nearest].pixel, PanelMark::kFound});
      const Eigen::Vector2d error = places[nearest].pixel - spot.pixel;
      row.squared_error += error.squaredNorm();
      row.nees += error.dot(places[nearest].covariance.inverse() * error);
    } else {
      ++row.missed;
      marked.push_back({spot.pixel, PanelMark::kMissed});
    }
  }
  row.false_dots += static_cast<int>(std::count(used.begin(), used.end(), false));
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!used[i]) marked.push_back({places[i].pixel, PanelMark::kFalse});
}

// What a frame of its kind is shown about: the middle of the card, the Moon, the image.
Eigen::Vector2d middle_of(const ShownFrame& frame, ground::TruthSpot::Kind kind) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (const ground::TruthSpot& spot : frame.spots) {
    if (spot.kind != kind) continue;
    sum += spot.pixel;
    ++count;
  }
  if (kind == ground::TruthSpot::Kind::kStar || count == 0)
    return {0.5 * frame.image.width, 0.5 * frame.image.height};
  return sum / count;
}

bool has(const std::vector<ground::TruthSpot>& spots, ground::TruthSpot::Kind kind) {
  return std::any_of(spots.begin(), spots.end(), [&](const ground::TruthSpot& s) { return s.kind == kind; });
}

}  // namespace

int bench_pipelines(Options& options) {
  std::string frames = "build/demo/frames";
  std::string mission_file = "config/demo.toml";
  std::string picture_file;
  int one_of = 20;
  options.add("--frames", frames, "rendered frames with truth");
  options.add("--mission", mission_file, "how they are flown");
  options.add("--every", one_of, "one frame set of so many");
  options.add("--picture", picture_file, "PNG to draw the three kinds of frame into");
  options.read();
  const std::filesystem::path folder = frames;
  const Mission mission = read_mission(mission_file);
  const auto truth = ground::read_truth(folder / "truth.jsonl", static_cast<int>(mission.cameras.size()));
  const auto every = static_cast<std::uint64_t>(one_of);
  Algorithm algorithms[] = {{"omma", ExtractorAlgorithm::kMatched},
                            {"MLAS (4)", ExtractorAlgorithm::kMlas},
                            {"small target (5)", ExtractorAlgorithm::kSmallTarget},
                            {"stars (7)", ExtractorAlgorithm::kStars}};
  const char* kinds[] = {"stars alone", "card and stars", "Moon and stars"};
  using Kind = ground::TruthSpot::Kind;
  constexpr Kind kShown[] = {Kind::kStar, Kind::kTarget, Kind::kMoon};
  Row rows[3][4];
  PipelinePicture picture(3, 4);
  bool is_shown[3] = {};
  for (const ground::TruthFrame& at : truth) {
    if (at.frame % every != 0) continue;
    for (std::size_t c = 0; c < mission.cameras.size(); ++c) {
      ShownFrame frame;
      const std::string name(mission.rig.cameras[c].name.view());
      char file[32];
      std::snprintf(file, sizeof file, "_%06d.png", static_cast<int>(at.frame));
      frame.image = read_image(folder / name / (name + file));
      frame.white_level = static_cast<std::uint16_t>((1 << mission.cameras[c].bits) - 1);
      frame.parameters = mission.cameras[c].dots.parameters;
      for (const ground::TruthSpot& spot : at.spots)
        if (spot.camera == static_cast<int>(c)) frame.spots.push_back(spot);
      const bool card = has(frame.spots, ground::TruthSpot::Kind::kTarget);
      const bool moon = has(frame.spots, ground::TruthSpot::Kind::kMoon);
      ImageView view = frame.image.view();
      view.white_level = frame.white_level;
      for (std::size_t k = 0; k < std::size(kinds); ++k) {
        if (!(k == 0 ? !card && !moon : k == 1 ? card : moon)) continue;
        for (std::size_t a = 0; a < std::size(algorithms); ++a) {
          Panel panel{static_cast<int>(k),
                      static_cast<int>(a),
                      std::string(kinds[k]) + ": " + algorithms[a].name(),
                      {}};
          judge(frame, algorithms[a], rows[k][a], panel.places);
          if (!picture_file.empty() && !is_shown[k]) picture.put(panel, view, middle_of(frame, kShown[k]));
        }
        is_shown[k] = true;
      }
    }
  }
  std::printf("spots of signal-to-noise ratio above %g; false: dots further than %g px from any true spot\n",
              kCounts, kNear);
  for (std::size_t k = 0; k < std::size(kinds); ++k) {
    if (rows[k][0].images == 0) continue;
    std::printf("%s, %d images\n  %-18s %8s %8s %13s %8s %8s %9s\n", kinds[k], rows[k][0].images, "", "found",
                "missed", "false/image", "rms px", "NEES", "median ms");
    for (std::size_t a = 0; a < std::size(algorithms); ++a) {
      const Row& row = rows[k][a];
      std::printf("  %-18s %8d %8d %13.2f %8.3f %8.2f %9.2f\n", algorithms[a].name(), row.found, row.missed,
                  static_cast<double>(row.false_dots) / row.images,
                  row.found == 0 ? 0 : std::sqrt(row.squared_error / (2 * row.found)),
                  row.found == 0 ? 0 : row.nees / row.found, 1e-3 * quantile(row.times, 0.5));
    }
  }
  if (!picture_file.empty()) picture.write(picture_file);
  return 0;
}

}  // namespace omma
