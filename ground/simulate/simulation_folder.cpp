#include "ground/simulate/simulation_folder.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/toml_table.hpp"
#include "hal/recorded/exposures_file.hpp"
#include "hal/recorded/image_file.hpp"
#include "sim/truth_json.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScenarioFile = "scenario.json";
constexpr const char* kTruthFile = "truth.jsonl";

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw InputError(file.string(), 0, "file", "a place to write to", "an error while writing");
}

void copy_file_into(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error)
    throw InputError(to.string(), 0, "file", "a place to copy " + from.string() + " to", error.message());
}

std::string vector_text(const Eigen::VectorXd& v) {
  std::string text = "[";
  char number[40];
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    std::snprintf(number, sizeof number, "%s%.17g", i == 0 ? "" : ", ", v[i]);
    text += number;
  }
  return text + "]";
}

// "chain.yaml#cam1" names a file and a camera in it.
std::string without_anchor(const std::string& path) {
  return path.substr(0, path.find('#'));
}

}  // namespace

SimulationFolder::SimulationFolder(const fs::path& top, const sim::Scenario& scenario)
    : top_(top), scenario_(scenario) {
  std::error_code error;
  if (fs::exists(top_, error) && !fs::is_directory(top_, error)) {
    throw InputError(top_.string(), 0, "--out", "a folder", "a file");
  }
  if (fs::exists(top_, error) && !fs::is_empty(top_, error) && !fs::exists(top_ / kScenarioFile, error)) {
    throw InputError(top_.string(), 0, "--out", "a new or empty folder, or an earlier simulation",
                     "a folder with other files");
  }
  clear();
  for (const RigCamera& camera : scenario_.rig.cameras) {
    fs::create_directories(top_ / camera.name.view(), error);
    if (error) throw InputError(top_.string(), 0, "--out", "a folder that can be written", error.message());
  }
  copy_inputs();
}

// A shorter simulation must not leave the tail of a longer one behind.
void SimulationFolder::clear() const {
  std::error_code error;
  fs::remove(top_ / kTruthFile, error);
  for (const RigCamera& camera : scenario_.rig.cameras) {
    const fs::path folder = top_ / camera.name.view();
    if (!fs::is_directory(folder, error)) continue;
    const std::string prefix = std::string(camera.name.view()) + '_';
    std::vector<fs::path> frames;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path& file = entry.path();
      if (file.extension() == ".png" && file.filename().string().starts_with(prefix)) frames.push_back(file);
    }
    for (const fs::path& file : frames) fs::remove(file, error);
    fs::remove(folder / kExposuresFile, error);
  }
}

void SimulationFolder::copy_inputs() const {
  std::vector<std::string> lens_files;
  std::string rig = "name = \"" + std::string(scenario_.rig.name.view()) + "\"\n";
  const auto tables = TomlTable::read(scenario_.rig_file).tables("camera");
  for (std::size_t i = 0; i < scenario_.rig.cameras.size(); ++i) {
    const RigCamera& camera = scenario_.rig.cameras[i];
    const fs::path lens = tables[i].path("lens");
    lens_files.push_back("lenses/" + lens.filename().string());
    copy_file_into(without_anchor(lens.string()), top_ / without_anchor(lens_files.back()));
    rig +=
        "\n[[camera]]\nname = \"" + std::string(camera.name.view()) + "\"\nlens = \"" + lens_files.back() +
        "\"\nrig_from_camera = { quaternion_xyzw = " + vector_text(camera.rig_from_camera.rotation.coeffs()) +
        ", translation_m = " + vector_text(camera.rig_from_camera.translation) + " }\n";
  }
  write_text(top_ / "rig.toml", rig);
  std::vector<std::string> target_files;
  for (const sim::Card& card : scenario_.cards) {
    target_files.push_back("targets/" + card.target_file.filename().string());
    copy_file_into(card.target_file, top_ / target_files.back());
  }
  write_text(top_ / kScenarioFile, sim::scenario_json(scenario_, lens_files, target_files));
}

void SimulationFolder::write_image(int camera, std::uint64_t frame, const ImageView& image) const {
  const std::string name(scenario_.rig.cameras[static_cast<std::size_t>(camera)].name.view());
  char number[32];
  std::snprintf(number, sizeof number, "_%06llu.png", static_cast<unsigned long long>(frame));
  write_png(top_ / name / (name + number), image, PngEffort::kFast);
}

// Only of cameras whose exposure changes.
void SimulationFolder::write_exposures() const {
  for (std::size_t c = 0; c < scenario_.rig.cameras.size(); ++c) {
    const sim::Sensor& sensor = scenario_.sensors[c];
    if (sensor.bracket.empty()) continue;
    std::string text = std::string(kExposuresHeading) + '\n';
    for (std::uint64_t frame = 0; frame < static_cast<std::uint64_t>(scenario_.frames); ++frame)
      text += exposure_line(frame,
                            {.exposure_ns = std::llround(1e9 * sensor.bracket[frame % sensor.bracket.size()]),
                             .black_level = static_cast<float>(sensor.black_level)});
    write_text(top_ / scenario_.rig.cameras[c].name.view() / kExposuresFile, text);
  }
}

void SimulationFolder::write_truth(const std::vector<std::string>& lines) const {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  write_text(top_ / kTruthFile, text);
}

}  // namespace omma::ground
