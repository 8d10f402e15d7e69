// A table on the terminal; the message in a file where one is asked for.
#include "ground/objects/objects.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>

#include "components/catalogue/observer.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/objects/object_history.hpp"

namespace omma::ground {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct Arguments {
  std::string recording;
  std::string tdm;
  std::string epoch;
};

const char* name_of(omma_ObjectMotion motion) {
  static constexpr std::array kNames{"undecided", "moving", "with the stars", "with the rig"};
  const auto i = static_cast<std::size_t>(motion);
  return i < kNames.size() ? kNames[i] : "unknown";
}

std::string now_text() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return text.data();
}

void print(const ObjectHistories& histories) {
  std::printf(
      "number  motion          seen s            sightings   RA deg   Dec deg      arc deg  arcmin/s  "
      "cameras\n");
  for (const auto& [number, object] : histories.objects) {
    if (object.bearings.empty()) continue;
    const auto seconds = [&](std::int64_t time_ns) {
      return 1e-9 * static_cast<double>(time_ns - histories.first_time_ns);
    };
    const Eigen::Vector3d& d = object.bearings.back().direction;
    const double ra = std::atan2(d.y(), d.x()) * kDegrees;
    std::printf("%6u  %-14s %7.1f to %-7.1f  %9u  %8.3f  %+8.3f  %9.3f  %8.3f  ", number,
                name_of(object.newest.motion), seconds(object.newest.first_seen_ns),
                seconds(object.newest.last_seen_ns), object.newest.sightings, ra < 0 ? ra + 360 : ra,
                std::asin(d.z()) * kDegrees, object.arc() * kDegrees, object.mean_rate() * kDegrees * 60);
    for (unsigned c = 0; c < 8; ++c)
      if ((object.cameras >> c & 1U) != 0) std::printf("%u ", c);
    std::printf("\n");
  }
}

int objects(const Arguments& arguments) {
  if (!arguments.tdm.empty() && arguments.epoch.empty())
    throw InputError("arguments", 0, "--tdm", "--epoch with it: the UTC of the first frame set", "no epoch");
  const double epoch = arguments.epoch.empty() ? 0 : parse_utc(arguments.epoch);
  const ObjectHistories histories = read_object_histories(arguments.recording);
  print(histories);
  if (arguments.tdm.empty()) return 0;
  std::ofstream file(arguments.tdm, std::ios::binary | std::ios::trunc);
  file << tracking_data_message(histories, epoch, now_text());
  if (!file.flush()) throw InputError(arguments.tdm, 0, "--tdm", "a file that can be written", "none");
  return 0;
}

}  // namespace

void add_objects(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("objects", "Unknown objects of a recording: how they moved, and their bearings");
  command->add_option("recording", arguments->recording, "recording (MCAP)")->required();
  command->add_option("--tdm", arguments->tdm, "file for the bearings as a CCSDS Tracking Data Message");
  command->add_option("--epoch", arguments->epoch, "UTC of the first frame set");
  command->callback([arguments, &context] { context.exit_code = objects(*arguments); });
}

}  // namespace omma::ground
