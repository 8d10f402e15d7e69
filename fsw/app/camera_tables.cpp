#include "fsw/app/camera_tables.hpp"

#include <algorithm>
#include <cmath>

#include "components/sensor/black_frame_file.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

constexpr std::size_t kMostOthers = 3;  // kinds of things one camera looks for besides

float read_float(const TomlTable& table, const char* key, Range range, float otherwise) {
  return static_cast<float>(table.number(key, range, otherwise));
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

void require_size(const TomlTable& table, const char* key, const Lens& lens, int width, int height) {
  if (width == lens.width() && height == lens.height()) return;
  throw table.error(key, size_text(lens.width(), lens.height()) + ", as the lens", size_text(width, height));
}

DotPolarity read_polarity(const TomlTable& table, const char* otherwise) {
  const std::string polarity = table.text("polarity", otherwise);
  if (polarity == "bright") return DotPolarity::kBright;
  if (polarity == "dark") return DotPolarity::kDark;
  if (polarity == "both") return DotPolarity::kBoth;
  throw table.error("polarity", "\"bright\", \"dark\" or \"both\"", polarity);
}

// Shares of the light at the axis, from the axis to the edge of the lens.
RelativeIllumination read_illumination(const TomlTable& table, const Lens& lens) {
  const std::vector<double> shares = table.number_list("relative_illumination");
  if (shares[0] != 1 || std::any_of(shares.begin(), shares.end(), [](double x) { return x <= 0 || x > 2; }))
    throw table.error("relative_illumination", "shares above 0, of which the first, on the axis, is 1",
                      "others");
  return {lens, shares};
}

void add_boxes(const TomlTable& table, PixelMask& mask) {
  const std::vector<double> boxes = table.number_list("boxes", 4);
  for (std::size_t i = 0; i < boxes.size(); i += 4) {
    const auto side = [&](std::size_t k) { return static_cast<int>(std::lround(boxes[i + k])); };
    if (side(2) < side(0) || side(3) < side(1))
      throw table.error("boxes", "left, top, right and bottom of each box", "a box turned inside out");
    mask.add_box(side(0), side(1), side(2), side(3));
  }
}

void add_polygon(const TomlTable& table, PixelMask& mask) {
  const std::vector<double> numbers = table.number_list("corners", 2);
  if (numbers.size() < 6) throw table.error("corners", "u and v of three corners at least", "fewer");
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < numbers.size(); i += 2) corners.emplace_back(numbers[i], numbers[i + 1]);
  mask.add_polygon(corners);
  table.refuse_unknown_keys();
}

// The keys of the one algorithm are not the other's.
void refuse_keys(const TomlTable& table, std::initializer_list<const char*> keys, const char* wanted,
                 const std::string& found) {
  for (const char* key : keys)
    if (table.has(key)) throw table.error(key, wanted, "algorithm = \"" + found + "\"");
}

int read_odd(const TomlTable& table, const char* key, Range range, int otherwise) {
  const auto number = static_cast<int>(table.integer(key, range, otherwise));
  if (number % 2 == 0) throw table.error(key, "an odd number of pixels", std::to_string(number));
  return number;
}

void read_classical(const TomlTable& table, ExtractorParameters& p) {
  ClassicalParameters& classical = p.classical;
  if (p.algorithm == ExtractorAlgorithm::kStars) classical.deviations = 3.5;
  classical.window = read_odd(table, "local_window_px", {3, 501}, classical.window);
  classical.deviations = table.number("local_deviations", {-5, 50}, classical.deviations);
  classical.background_window = read_odd(table, "background_window_px", {3, 31}, classical.background_window);
  classical.least_area = static_cast<int>(table.integer("least_area_px", {1, 10000}, classical.least_area));
}

ExtractorAlgorithm read_algorithm(const TomlTable& table) {
  const std::string algorithm = table.text("algorithm", "omma");
  if (algorithm == "omma") {
    refuse_keys(table, {"local_window_px", "local_deviations", "background_window_px", "least_area_px"},
                "an algorithm of \"mlas\", \"small-target\" or \"stars\" with it", algorithm);
    return ExtractorAlgorithm::kMatched;
  }
  refuse_keys(table, {"threshold", "max_point_sigma_px", "min_sigma_px", "keep_hot_pixels"},
              "an algorithm of \"omma\" with it", algorithm);
  if (algorithm == "mlas") return ExtractorAlgorithm::kMlas;
  if (algorithm == "small-target") return ExtractorAlgorithm::kSmallTarget;
  if (algorithm == "stars") return ExtractorAlgorithm::kStars;
  throw table.error("algorithm", "\"omma\", \"mlas\", \"small-target\" or \"stars\"", algorithm);
}

ExtractorParameters read_extractor(const TomlTable& table) {
  ExtractorParameters p;
  p.algorithm = read_algorithm(table);
  if (p.algorithm != ExtractorAlgorithm::kMatched) read_classical(table, p);
  // What is looked for chooses the rest, each of which may be given all the same.
  const std::string kind = table.text("for", "all");
  if (kind == "stars") {
    p.max_diameter = 24;
  } else if (kind == "targets") {
    p.max_diameter = 80;
  } else if (kind != "all") {
    throw table.error("for", "\"stars\", \"targets\" or \"all\"", kind);
  }
  p.polarity = read_polarity(table, "bright");
  p.threshold = read_float(table, "threshold", {1, 100}, p.threshold);
  p.gain = read_float(table, "gain_e_per_level", {0, 1e6}, p.gain);
  p.black_level = read_float(table, "black_level", {0, 65535}, p.black_level);
  p.min_snr = read_float(table, "min_snr", {0, 1000}, p.min_snr);
  p.max_point_sigma = read_float(table, "max_point_sigma_px", {0.5, 4}, p.max_point_sigma);
  p.min_sigma = read_float(table, "min_sigma_px", {0.1, 2}, p.min_sigma);
  p.max_diameter = static_cast<int>(table.integer("max_diameter_px", {3, 80}, p.max_diameter));
  p.elongation = read_float(table, "elongation", {1, 100}, p.elongation);
  p.keep_hot_pixels = table.flag("keep_hot_pixels", p.keep_hot_pixels);
  table.refuse_unknown_keys();
  return p;
}

}  // namespace

void read_extractors(const TomlTable& camera, ExtractorCamera& dots) {
  if (const auto table = camera.table_if("extractor")) dots.parameters = read_extractor(*table);
  for (const TomlTable& table : camera.tables_if("also_extractor")) {
    dots.also.push_back(read_extractor(table));
    for (const char* key : {"gain_e_per_level", "black_level"})
      if (table.has(key)) throw table.error(key, "it in the camera's `extractor` table", "it here");
  }
  if (dots.also.size() > kMostOthers)
    throw camera.error("also_extractor", "at most " + std::to_string(kMostOthers) + " tables",
                       std::to_string(dots.also.size()));
}

void read_sensor(const TomlTable& camera, const Lens& lens, ExtractorCamera& dots, double& read_noise_e) {
  const auto found = camera.table_if("sensor");
  if (!found) return;
  const TomlTable& table = *found;
  SensorCalibration& sensor = dots.sensor;
  sensor.black_level = dots.parameters.black_level;
  double noise = 1;  // of a pixel in the dark [raw grey levels]
  if (table.has("black_frame")) {
    sensor.black = read_black_frame(table.path("black_frame"));
    require_size(table, "black_frame", lens, sensor.black.width, sensor.black.height);
    if (sensor.black.frames > 1) noise = std::max(0.3, static_cast<double>(sensor.black.typical_noise()));
    sensor.ageing_step = table.number("black_frame_ageing", {0, 1}, 0);
  }
  if (table.has("response")) {
    sensor.response = read_response_curve(table.path("response"));
    const double black =
        sensor.black.empty() ? sensor.black_level : static_cast<double>(sensor.black.typical_mean());
    dots.parameters.relative_noise = static_cast<float>(sensor.response.relative_noise(noise, black));
  }
  dots.parameters.relative_noise =
      read_float(table, "relative_noise", {0, 1}, dots.parameters.relative_noise);
  read_noise_e = table.number("read_noise_e", {0.1, 1e4}, read_noise_e);
  dots.parameters.fill_factor = read_float(table, "fill_factor", {0.01, 1}, dots.parameters.fill_factor);
  if (table.has("relative_illumination")) dots.illumination = read_illumination(table, lens);
  table.refuse_unknown_keys();
}

void read_mask(const TomlTable& camera, const Lens& lens, ExtractorCamera& dots) {
  const auto found = camera.table_if("mask");
  if (!found) return;
  const TomlTable& table = *found;
  dots.mask = PixelMask(lens.width(), lens.height());
  if (table.has("beyond_deg")) dots.mask.add_outside(lens, table.number("beyond_deg", {1, 180}) * M_PI / 180);
  if (table.has("picture")) {
    const Image picture = read_image(table.path("picture"));
    require_size(table, "picture", lens, picture.width, picture.height);
    dots.mask.add_bright_half(picture.view());
  }
  if (table.has("boxes")) add_boxes(table, dots.mask);
  for (const TomlTable& polygon : table.tables_if("polygon")) add_polygon(polygon, dots.mask);
  dots.mask.grow(static_cast<int>(table.integer("grow_px", {0, 100}, 0)));
  if (const auto glare = table.table_if("glare")) {
    GlareParameters p;
    p.bright = glare->number("bright", {0.05, 1}, p.bright);
    p.least_blocks = static_cast<int>(glare->integer("least_blocks", {1, 1000}, p.least_blocks));
    p.margin = glare->number("margin", {0, 2}, p.margin);
    glare->refuse_unknown_keys();
    dots.glare = p;
  }
  if (dots.mask.share() == 1)
    throw table.error("mask", "a camera that still sees something", "all of it masked");
  table.refuse_unknown_keys();
}

// Several exposures in turn.
void read_bracket(const TomlTable& table, ExposureParameters& p) {
  if (!table.has("bracket_ms")) return;
  if (p.automatic)
    throw table.error("bracket_ms", "automatic exposure or a bracket, not both", "automatic = true as well");
  const std::vector<double> exposures = table.number_list("bracket_ms");
  if (exposures.size() < 2 || exposures.size() > kMostBracketed)
    throw table.error("bracket_ms", "2 to " + std::to_string(kMostBracketed) + " exposures",
                      std::to_string(exposures.size()));
  for (const double exposure : exposures) {
    if (!(exposure >= 0.001 && exposure <= 60000))
      throw table.error("bracket_ms", "exposures from 0.001 to 60000 ms", std::to_string(exposure));
    p.bracket_ns.push_back(static_cast<TimeNs>(std::llround(1e6 * exposure)));
  }
}

ExposureParameters read_exposure(const TomlTable& camera) {
  ExposureParameters p;
  const auto found = camera.table_if("exposure");
  if (!found) return p;
  const TomlTable& table = *found;
  p.automatic = table.flag("automatic", !table.has("bracket_ms"));
  const auto milliseconds = [&](const char* key, TimeNs otherwise) {
    return static_cast<TimeNs>(
        std::llround(1e6 * table.number(key, {0.001, 60000}, 1e-6 * static_cast<double>(otherwise))));
  };
  p.shortest_ns = milliseconds("shortest_ms", p.shortest_ns);
  p.longest_ns = milliseconds("longest_ms", p.longest_ns);
  if (p.longest_ns < p.shortest_ns)
    throw table.error("longest_ms", "no less than shortest_ms",
                      std::to_string(1e-6 * static_cast<double>(p.longest_ns)));
  p.most_gain = table.number("most_gain", {1, 1e4}, p.most_gain);
  p.dark = table.number("dark", {0.001, 0.9}, p.dark);
  p.target = table.number("target", {0.001, 0.9}, p.target);
  p.bright = table.number("bright", {0.001, 0.95}, p.bright);
  if (!(p.dark < p.target && p.target < p.bright))
    throw table.error("target", "a number between dark and bright", std::to_string(p.target));
  p.enough_noise = table.number("enough_noise", {0.3, 1000}, p.enough_noise);
  p.most_full = table.number("most_full", {0, 1}, p.most_full);
  p.settle = static_cast<int>(table.integer("settle_frames", {1, 1000}, p.settle));
  p.patience = static_cast<int>(table.integer("patience_frames", {1, 1000000}, p.patience));
  read_bracket(table, p);
  table.refuse_unknown_keys();
  return p;
}

}  // namespace omma
