// `omma calibrate lens`: a lens from views of a checkerboard, or from corners found before.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"
#include "ground/calibrate/board_adjustment.hpp"
#include "ground/calibrate/calibrate.hpp"
#include "ground/calibrate/sky_adjustment.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Arguments {
  std::vector<std::string> images;
  std::vector<std::string> test_images;
  std::string board;
  double square_mm = 25;
  std::string board_file;
  std::string model = "kb4";
  std::string output;
  bool json = false;
};

struct Views {
  std::vector<BoardView> views;
  std::vector<std::string> without;  // images in which the board was not found
  int width = 0;
  int height = 0;
};

Checkerboard board_of(const Arguments& a) {
  const std::size_t x = a.board.find('x');
  const int columns = whole_number(a.board.substr(0, x)).value_or(0);
  const int rows = x == std::string::npos ? 0 : whole_number(a.board.substr(x + 1)).value_or(0);
  if (columns < 3 || rows < 3 || columns > 100 || rows > 100)
    throw InputError("arguments", 0, "--board", "COLUMNSxROWS of inner corners, 3 to 100 each, such as 9x6",
                     a.board);
  return {columns, rows, 1e-3 * a.square_mm};
}

void same_size(const std::string& file, int width, int height, Views& views) {
  if (views.width == 0) {
    views.width = width;
    views.height = height;
  }
  if (width != views.width || height != views.height)
    throw InputError(file, 0, "image size", format("%d x %d as the first", views.width, views.height),
                     format("%d x %d", width, height));
}

void add_views(const Arguments& a, const std::vector<std::string>& files, Views& views) {
  for (const std::string& file : files) {
    if (file.ends_with(".orpc")) {
      int width = 0;
      int height = 0;
      BoardView view = read_corners(file, a.board_file, width, height);
      same_size(file, width, height, views);
      views.views.push_back(std::move(view));
      continue;
    }
    const Image image = read_image(file);
    same_size(file, image.width, image.height, views);
    auto view = find_checkerboard(image.view(), board_of(a), file);
    if (view) {
      views.views.push_back(std::move(*view));
    } else {
      views.without.push_back(file);
    }
  }
}

void check(const Arguments& a) {
  bool corners = false;
  bool images = false;
  for (const auto* files : {&a.images, &a.test_images}) {
    for (const std::string& file : *files) (file.ends_with(".orpc") ? corners : images) = true;
  }
  if (corners && a.board_file.empty())
    throw InputError("arguments", 0, "--board-file", "the board's .dsc file with .orpc corners", "none");
  if (images) board_of(a);
}

double rms_of(const std::vector<Eigen::Vector2d>& residuals) {
  double sum = 0;
  for (const Eigen::Vector2d& r : residuals) sum += r.squaredNorm();
  return residuals.empty() ? 0 : std::sqrt(sum / double(residuals.size()));
}

struct Result {
  Views views;
  BoardAdjustment train;
  BoardAdjustment test;  // no views: none asked for
  std::vector<std::string> test_names;
};

BoardAdjustment test_views(const LensShape& shape, const std::vector<BoardView>& views) {
  const Lens lens = shape.lens().value();
  std::vector<Pose> poses;
  for (const BoardView& view : views) {
    const auto pose = board_pose(view, lens);
    if (!pose) throw InputError(view.name, 0, "board", "a pose that follows from the corners", "none");
    poses.push_back(*pose);
  }
  return adjust_to_boards(shape, views, poses, true);
}

std::string text_of(const Result& r) {
  std::string text = format("rms %.4f px over %zu views\n", r.train.rms_px, r.views.views.size());
  for (std::size_t v = 0; v < r.views.views.size(); ++v)
    text += format("  %-60s %.4f px, %zu corners\n", r.views.views[v].name.c_str(),
                   rms_of(r.train.residuals[v]), r.train.residuals[v].size());
  for (const std::string& file : r.views.without) text += "  " + file + ": no board found\n";
  if (!r.test_names.empty())
    text += format("test rms %.4f px over %zu views\n", r.test.rms_px, r.test_names.size());
  const std::vector<std::string> names = r.train.shape.names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    text += format("  %-9s %14.7f  +- %.7f\n", names[k].c_str(), r.train.shape.parameters[i],
                   std::sqrt(std::max(0.0, r.train.lens_covariance(i, i))));
  }
  return text;
}

std::string json_of(const Result& r) {
  nlohmann::ordered_json json{{"rms_px", r.train.rms_px}, {"views", nlohmann::ordered_json::array()}};
  for (std::size_t v = 0; v < r.views.views.size(); ++v)
    json["views"].push_back({{"name", r.views.views[v].name},
                             {"rms_px", rms_of(r.train.residuals[v])},
                             {"corners", r.train.residuals[v].size()}});
  json["without_board"] = r.views.without;
  if (!r.test_names.empty()) json["test"] = {{"rms_px", r.test.rms_px}, {"views", r.test_names.size()}};
  const std::vector<std::string> names = r.train.shape.names();
  json["parameters"] = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    json["parameters"][names[k]] = {{"value", r.train.shape.parameters[i]},
                                    {"sigma", std::sqrt(std::max(0.0, r.train.lens_covariance(i, i)))}};
  }
  return json.dump(2) + "\n";
}

std::string page_of(const Result& r) {
  XySeries all{"", "a", Mark::kPoints, {}};
  XySeries radial{"", "a", Mark::kPoints, {}};
  const Lens lens = r.train.shape.lens().value();
  double widest = 0;
  for (std::size_t v = 0; v < r.train.residuals.size(); ++v) {
    for (std::size_t k = 0; k < r.train.residuals[v].size(); ++k) {
      const Eigen::Vector2d& residual = r.train.residuals[v][k];
      const Eigen::Vector2d& pixel = r.views.views[v].pixels[k];
      Eigen::Vector3d ray;
      lens.bearing(pixel, ray);
      const double angle = std::atan2(ray.head<2>().norm(), ray.z());
      widest = std::max(widest, angle);
      all.points.push_back(residual);
      radial.points.emplace_back(angle / kDegree, residual.dot((pixel - lens.centre()).normalized()));
    }
  }
  std::vector<double> angles;
  for (int k = 1; k <= 12; ++k) angles.push_back(widest * k / 12);
  const std::vector<double> deviations = lens_deviations(r.train.shape, r.train.lens_covariance, angles);
  XySeries known{"", "a", Mark::kLine, {}};
  for (std::size_t k = 0; k < angles.size(); ++k)
    known.points.emplace_back(angles[k] / kDegree, deviations[k]);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t v = 0; v < r.views.views.size(); ++v)
    rows.push_back({escaped(std::filesystem::path(r.views.views[v].name).filename().string()),
                    format("%zu", r.train.residuals[v].size()),
                    format("%.3f px", rms_of(r.train.residuals[v]))});
  std::string figures =
      figure(format("%.3f px", r.train.rms_px), format("rms of %zu views", r.views.views.size()));
  if (!r.test_names.empty())
    figures += figure(format("%.3f px", r.test.rms_px), format("rms of %zu test views", r.test_names.size()));
  return page_head("Omma: lens calibration", "Lens calibration", "A lens from views of a board.") +
         figures_row(figures) + "<h2>Residuals</h2><div class='charts'>" +
         xy_chart({"All corners", {"right [px]", false, 0, 0}, {"down [px]", false, 0, 0}, {all}, true}) +
         xy_chart({"Radial", {"off axis [&deg;]", false, 0, 0}, {"outwards [px]", false, 0, 0}, {radial}}) +
         xy_chart({"How well the lens is known",
                   {"off axis [&deg;]", false, 0, 0},
                   {"1 &sigma; [px]", false, 0, 0},
                   {known}}) +
         "</div><h2>Views</h2>" + table({"view", "corners", "rms"}, rows) + page_end();
}

int calibrate(const Arguments& a) {
  check(a);
  Result r;
  add_views(a, a.images, r.views);
  if (r.views.views.size() < 3) {
    std::printf("no calibration: the board was found in %zu of %zu images; three are needed\n",
                r.views.views.size(), a.images.size());
    return 1;
  }
  const LensModel model = a.model == "ocam"
                              ? LensModel::kOcam
                              : (a.model == "kb4" ? LensModel::kKannalaBrandt : LensModel::kCaltech);
  BoardCalibration calibration = calibrate_from_boards(r.views.views, r.views.width, r.views.height, model);
  if (!calibration.reason.empty()) {
    std::printf("no calibration: %s\n", calibration.reason.c_str());
    return 1;
  }
  r.train = std::move(calibration.adjustment);
  Views test{{}, {}, r.views.width, r.views.height};
  add_views(a, a.test_images, test);
  if (!test.views.empty()) {
    r.test = test_views(r.train.shape, test.views);
    for (const BoardView& view : test.views) r.test_names.push_back(view.name);
  }
  std::fputs((a.json ? json_of(r) : text_of(r)).c_str(), stdout);
  if (a.output.empty()) return 0;
  make_folder(a.output, "--output");
  const std::filesystem::path folder = a.output;
  const std::string name =
      a.model == "ocam" ? "calib_results.txt" : (a.model == "kb4" ? "camchain.yaml" : "Calib_Results.m");
  write_text_file((folder / name).string(), lens_file_text(r.train.shape.lens().value()));
  write_text_file((folder / "calibration.json").string(), json_of(r));
  write_page((folder / "calibration.html").string(), page_of(r));
  std::fprintf(stderr, "lens and page written: %s\n", (folder / name).c_str());
  return 0;
}

}  // namespace

void add_calibrate_lens(CLI::App& calibrate_command, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = calibrate_command.add_subcommand("lens", "Lens from views of a checkerboard");
  command
      ->add_option("images", arguments->images,
                   "Pictures of the board, or .orpc files of corners found before")
      ->required();
  command->add_option("--board", arguments->board, "Inner corners of the checkerboard, COLUMNSxROWS (9x6)");
  command->add_option("--square", arguments->square_mm, "Side of a square [mm]")->check(CLI::Range(0.1, 1e4));
  command->add_option("--board-file", arguments->board_file, "Board of the .orpc files (.dsc)");
  command->add_option("--test", arguments->test_images, "Views that judge the lens and do not make it");
  command->add_option("--model", arguments->model, "kb4, ocam or caltech")
      ->check(CLI::IsMember({"kb4", "ocam", "caltech"}));
  command->add_option("--output", arguments->output,
                      "Folder for the lens file, calibration.html and calibration.json");
  command->add_flag("--json", arguments->json, "One JSON object instead of text");
  command->callback([arguments, &context] { context.exit_code = calibrate(*arguments); });
}

}  // namespace omma::ground
