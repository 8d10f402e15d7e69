#include "ground/report/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>

#include "components/telemetry/topics.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/report/report_page.hpp"
#include "ground/report/report_pictures.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string recording;
  std::string frames;
  std::string mission;
  std::string output;
};

/// demo.mcap → demo.timing.mcap, as the flight program writes it.
std::filesystem::path timing_file(const std::filesystem::path& recording) {
  return recording.parent_path() / (recording.stem().string() + ".timing" + recording.extension().string());
}

std::filesystem::path frame_file(const std::filesystem::path& frames, const std::string& camera,
                                 std::uint64_t frame) {
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "_%06llu.png", static_cast<unsigned long long>(frame));
  return frames / camera / (camera + number.data());
}

StarCatalogue star_catalogue(const FlownMission& mission) {
  Observer observer;
  if (mission.julian_date_utc) observer.julian_date_utc = *mission.julian_date_utc;
  return {observer, {.magnitude_limit = 6.5F, .resolution = 0.003}};
}

// The frame with most targets paired says most; the last of equals.
std::uint64_t frame_to_show(const FlightLog& log) {
  std::uint64_t best = log.dots.begin()->first;
  long most = -1;
  for (const auto& [frame, cameras] : log.dots) {
    long targets = 0;
    for (const auto& dots : cameras) {
      targets += std::count_if(dots.begin(), dots.end(), [](const omma_Dot& dot) {
        return dot.role == omma_DOT_TARGET && !dot.culled;
      });
    }
    if (targets >= most) {
      most = targets;
      best = frame;
    }
  }
  return best;
}

/// Of a whole panorama, as a share of the sphere.
double share_not_seen(const ChunkPicture& panorama) {
  double dark = 0;
  double all = 0;
  for (int v = 0; v < panorama.picture.height; ++v) {
    const double weight = std::sin(std::numbers::pi * (v + 0.5) / panorama.picture.height);
    for (int u = 0; u < panorama.picture.width; ++u) {
      all += weight;
      if (panorama.levels[static_cast<std::size_t>(v * panorama.picture.width + u)] == 0) dark += weight;
    }
  }
  return all > 0 ? dark / all : 0;
}

std::vector<ReportPicture> pictures_of(const FlownMission& mission, const FlightLog& log,
                                       const std::filesystem::path& frames) {
  std::vector<ReportPicture> pictures;
  if (const ChunkPicture* panorama = log.pictures.last_complete(omma_IMAGE_PANORAMA_J2000)) {
    pictures.push_back({"panorama.png",
                        "The whole sky in J2000, right ascension growing to the left, made on board from all "
                        "cameras. Black is what no camera of the rig looks at, " +
                            format("%.1f", 100 * share_not_seen(*panorama)) +
                            " % of the sphere; the sky that was seen is grey with its noise. Stars brighter "
                            "than V 2.2 are named "
                            "where the attitude and the catalogue put them.",
                        panorama_picture(*panorama, star_catalogue(mission)).png()});
  }
  if (log.dots.empty()) return pictures;
  const std::uint64_t frame = frame_to_show(log);
  const auto& cameras = log.dots.at(frame);
  for (std::size_t c = 0; c < mission.rig.cameras.size() && c < cameras.size(); ++c) {
    const std::string camera(mission.rig.cameras[c].name.view());
    pictures.push_back(
        {camera + ".png",
         camera + ": stars used green, targets used blue, pairs culled red, unpaired dots grey.",
         camera_picture(frame_file(frames, camera, frame), mission, cameras[c], camera, frame).png()});
  }
  return pictures;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out)
    throw InputError(file.string(), 0, "--output", "a folder that can be written", "an error while writing");
}

int report(const Arguments& arguments) {
  const FlownMission mission = read_flown_mission(arguments.mission);
  const std::filesystem::path frames = arguments.frames;
  const FlightLog log = read_flight_log(arguments.recording);
  const std::vector<TruthFrame> truth =
      read_truth(frames / "truth.jsonl", static_cast<int>(mission.rig.cameras.size()));

  ReportContent content;
  content.spacecraft = log.spacecraft;
  content.evaluation = evaluate(mission, truth, log, arguments.recording);
  const std::filesystem::path timing = timing_file(arguments.recording);
  if (std::filesystem::exists(timing)) content.times = read_times(timing.string());
  content.pictures = pictures_of(mission, log, frames);

  const std::filesystem::path output = arguments.output;
  std::error_code failure;
  std::filesystem::create_directories(output, failure);
  if (failure)
    throw InputError(output.string(), 0, "--output", "a folder that can be made", failure.message());
  for (const ReportPicture& picture : content.pictures)
    write_bytes((output / picture.file).string(), picture.png);
  write_text(output / "report.json", report_json(content));
  write_page((output / "report.html").string(), report_page(content));
  std::fputs(report_text(content).c_str(), stdout);
  std::printf("report     %s\n", (output / "report.html").string().c_str());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Compare a flight over simulated frames with the truth: a page with pictures");
  command->add_option("recording", arguments->recording, "Log of the flight program (MCAP)")->required();
  command->add_option("--frames", arguments->frames, "Folder of the simulated frames, with truth.jsonl")
      ->required();
  command->add_option("--mission", arguments->mission, "Mission file that was flown (TOML)")->required();
  command->add_option("--output", arguments->output, "Folder for report.html, report.json and the pictures")
      ->required();
  command->callback([arguments, &context] { context.exit_code = report(*arguments); });
}

}  // namespace omma::ground
