// The extraction pipelines side by side on the same rendered frames with truth: star frames, frames with the
// card, frames with the Moon.
#include <cstdio>
#include <functional>
#include <memory>

#include "components/extractor/dot_extractor.hpp"
#include "fsw/app/mission.hpp"
#include "ground/dots/pipelines.hpp"
#include "ground/report/truth.hpp"
#include "hal/recorded/image_file.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/pipeline_picture.hpp"

namespace omma {
namespace {

constexpr double kNear = 1.5;  // a dot this near to a true spot is it [px]
constexpr double kCounts = 7;  // signal-to-noise ratio from which a missed spot is counted

struct ShownFrame {
  Image image;
  std::uint16_t white_level;
  ExtractorParameters parameters;
  std::vector<ground::TruthSpot> spots;
};

struct Row {
  int images = 0, found = 0, missed = 0, false_dots = 0;
  double squared_error = 0;
  std::vector<double> times;
};

using Extract = std::function<std::vector<Eigen::Vector2d>(const ShownFrame&, double& microseconds)>;

std::vector<Eigen::Vector2d> own(const ShownFrame& frame, double& us) {
  ImageView view = frame.image.view();
  view.white_level = frame.white_level;
  DotExtractor extractor(view.width, view.height);
  const auto list = std::make_unique<DotList>();
  extractor.extract(view, frame.parameters, *list);  // the scratch is in the caches of a flight too
  us = microseconds([&] { extractor.extract(view, frame.parameters, *list); });
  std::vector<Eigen::Vector2d> places;
  for (const Dot& dot : list->dots) places.push_back(dot.pixel);
  return places;
}

template <class Pipeline>
Extract classical(Pipeline&& pipeline) {
  return [pipeline](const ShownFrame& frame, double& us) {
    std::vector<ground::ClassicalDot> dots;
    us = microseconds([&] { dots = pipeline(ground::grey_image(frame.image.view())); });
    std::vector<Eigen::Vector2d> places;
    for (const ground::ClassicalDot& dot : dots) places.push_back(dot.pixel);
    return places;
  };
}

// Adds to the row, and to `marked` what became of each place.
void judge(const ShownFrame& frame, const Extract& extract, Row& row, std::vector<MarkedPlace>& marked) {
  double us = 0;
  const std::vector<Eigen::Vector2d> places = extract(frame, us);
  row.times.push_back(us);
  ++row.images;
  std::vector<bool> used(places.size(), false);
  for (const ground::TruthSpot& spot : frame.spots) {
    std::size_t nearest = places.size();
    double least = kNear;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double distance = (places[i] - spot.pixel).norm();
      if (used[i] || distance >= least) continue;
      nearest = i;
      least = distance;
    }
    if (nearest < places.size()) used[nearest] = true;
    if (spot.snr < kCounts || spot.kind == ground::TruthSpot::Kind::kMoon) continue;
    if (nearest < places.size()) {
      ++row.found;
      marked.push_back({places[nearest], PanelMark::kFound});
      row.squared_error += least * least;
    } else {
      ++row.missed;
      marked.push_back({spot.pixel, PanelMark::kMissed});
    }
  }
  row.false_dots += static_cast<int>(std::count(used.begin(), used.end(), false));
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!used[i]) marked.push_back({places[i], PanelMark::kFalse});
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

int bench_pipelines(int argc, char** argv) {
  const std::filesystem::path folder = text_option(argc, argv, "--frames", "build/demo/frames");
  const Mission mission = read_mission(text_option(argc, argv, "--mission", "config/demo.toml"));
  const auto truth = ground::read_truth(folder / "truth.jsonl", static_cast<int>(mission.cameras.size()));
  const auto every = static_cast<std::uint64_t>(std::max(1, option(argc, argv, "--every", 20)));
  // The factor of the local threshold at which each gives up about as many spots as it makes false ones.
  const ground::ClassicalParameters parameters;
  ground::ClassicalParameters for_stars;
  for_stars.deviations = 3.5;
  const std::pair<const char*, Extract> algorithms[] = {
      {"omma", own},
      {"MLAS (4)", classical([&](const ground::GreyImage& i) { return mlas_dots(i, parameters, {}); })},
      {"small target (5)",
       classical([&](const ground::GreyImage& i) { return small_target_dots(i, parameters, {}); })},
      {"stars (7)", classical([&](const ground::GreyImage& i) { return star_dots(i, {}, for_stars, {}); })},
  };
  const char* kinds[] = {"stars alone", "card and stars", "Moon and stars"};
  using Kind = ground::TruthSpot::Kind;
  constexpr Kind kShown[] = {Kind::kStar, Kind::kTarget, Kind::kMoon};
  Row rows[3][4];
  const char* picture_file = text_option(argc, argv, "--picture", nullptr);
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
                      std::string(kinds[k]) + ": " + algorithms[a].first,
                      {}};
          judge(frame, algorithms[a].second, rows[k][a], panel.places);
          if (picture_file != nullptr && !is_shown[k]) picture.put(panel, view, middle_of(frame, kShown[k]));
        }
        is_shown[k] = true;
      }
    }
  }
  std::printf("spots of signal-to-noise ratio above %g; false: dots further than %g px from any true spot\n",
              kCounts, kNear);
  for (std::size_t k = 0; k < std::size(kinds); ++k) {
    if (rows[k][0].images == 0) continue;
    std::printf("%s, %d images\n  %-18s %8s %8s %13s %8s %9s\n", kinds[k], rows[k][0].images, "", "found",
                "missed", "false/image", "rms px", "median ms");
    for (std::size_t a = 0; a < std::size(algorithms); ++a) {
      const Row& row = rows[k][a];
      std::printf("  %-18s %8d %8d %13.2f %8.3f %9.2f\n", algorithms[a].first, row.found, row.missed,
                  static_cast<double>(row.false_dots) / row.images,
                  row.found == 0 ? 0 : std::sqrt(row.squared_error / (2 * row.found)),
                  1e-3 * quantile(row.times, 0.5));
    }
  }
  if (picture_file != nullptr) picture.write(picture_file);
  return 0;
}

}  // namespace omma
