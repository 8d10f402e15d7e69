#include "ground/calibrate/calibrate_flight.hpp"

#include <cstdio>
#include <filesystem>

#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/calibrate/drift_report.hpp"
#include "ground/calibrate/sky_files.hpp"
#include "ground/calibrate/sky_report.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr double kDay = 86400;

void check(const FlightCalibrationArguments& a) {
  for (const std::string& log : a.logs)
    if (!log.ends_with(".mcap"))
      throw InputError(log, 0, "images", "logs (.mcap) alone, or images alone", "both");
  if (a.rig.empty())
    throw InputError("arguments", 0, "--rig", "the rig file that was flown, with a flight's log", "none");
  if (a.epochs.size() > a.logs.size() || (a.logs.size() > 1 && a.epochs.size() != a.logs.size()))
    throw InputError("arguments", 0, "--epoch", "the time of frame 0 of each log",
                     format("%zu for %zu", a.epochs.size(), a.logs.size()));
}

std::vector<FlightSet> sets_of(const FlightCalibrationArguments& a, std::size_t k, const Rig& rig,
                               double first_date) {
  Observer observer;
  if (!a.epochs.empty()) observer.julian_date_utc = parse_utc(a.epochs[k]);
  if (!a.site.empty()) observer.site = parse_ground_site(a.site);
  const double start = observer.julian_date_utc ? (*observer.julian_date_utc - first_date) * kDay : 0;
  const FlightLog log = read_flight_log(a.logs[k]);
  for (const auto& [frame, cameras] : log.dots) {
    if (cameras.size() > rig.cameras.size())
      throw InputError(
          a.logs[k], 0, "dots", format("the %zu cameras of %s", rig.cameras.size(), a.rig.c_str()),
          format("%zu cameras in frame set %llu", cameras.size(), static_cast<unsigned long long>(frame)));
  }
  std::vector<FlightSet> sets = flight_sets(log, rig, observer, start);
  if (sets.empty())
    throw InputError(a.logs[k], 0, "dots", "frame sets with an attitude and the dots of its stars", "none");
  return sets;
}

std::vector<std::vector<FlightSet>> recordings_of(const FlightCalibrationArguments& a, const Rig& rig) {
  const double first_date = a.epochs.empty() ? 0 : parse_utc(a.epochs.front());
  std::vector<std::vector<FlightSet>> recordings;
  for (std::size_t k = 0; k < a.logs.size(); ++k) {
    recordings.push_back(sets_of(a, k, rig, first_date));
    if (k > 0 && recordings[k].front().time <= recordings[k - 1].back().time)
      throw InputError("arguments", 0, "--epoch", "logs in the order of time, none over another",
                       a.epochs[k]);
  }
  return recordings;
}

}  // namespace

int calibrate_flight(const FlightCalibrationArguments& a) {
  check(a);
  const Rig rig = read_rig_file(a.rig);
  DriftOptions options;
  options.model = a.model;
  const int usual = a.logs.size() == 1 ? 10 : 1;
  options.windows = static_cast<std::size_t>(a.windows > 0 ? a.windows : usual);
  const SkyDrift drift = drift_from_flight(rig, recordings_of(a, rig), options);
  if (!drift.done) {
    std::printf("no calibration: %s\n", drift.reason.c_str());
    return 1;
  }
  if (a.json) {
    std::fputs(drift_json(drift).c_str(), stdout);
  } else {
    std::fputs((sky_report_text(drift.mean) + drift_text(drift)).c_str(), stdout);
  }
  if (a.output.empty()) return 0;
  write_sky_calibration(drift.mean, a.output, true);
  const std::filesystem::path folder = a.output;
  write_text_file((folder / "drift.json").string(), drift_json(drift));
  write_page((folder / "drift.html").string(), drift_page(drift));
  return 0;
}

}  // namespace omma::ground
