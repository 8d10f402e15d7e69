#include "ground/objects/object_history.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "ground/recording.hpp"

namespace omma::ground {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

Eigen::Vector3d vector(const omma_Vector3& v) {
  return {v.x, v.y, v.z};
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return 2 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

/// 2026-04-02T02:00:00.123456
std::string utc_text(double julian_date, std::int64_t after_ns) {
  using std::chrono::days;
  using std::chrono::floor;
  constexpr double kUnixEpoch = 2440587.5;
  // A Julian date holds 0.04 ms: the epoch to the millisecond, what follows exactly.
  const std::chrono::milliseconds start(std::llround((julian_date - kUnixEpoch) * 86400e3));
  const std::chrono::sys_time<std::chrono::nanoseconds> time{start + std::chrono::nanoseconds(after_ns)};
  const auto day = floor<days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  return format("%04d-%02u-%02uT%02d:%02d:%02d.%06d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()),
                static_cast<int>(clock.subseconds().count() / 1000));
}

std::string segment(const ObjectHistories& histories, std::uint32_t number, const ObjectHistory& object,
                    double epoch) {
  double variance = 0;
  for (const Bearing& bearing : object.bearings)
    variance += bearing.sigma * bearing.sigma / static_cast<double>(object.bearings.size());
  std::string text = "META_START\n";
  text += format("COMMENT 1-sigma of each angle across the line of sight, rms: %.1f arcsec\n",
                 std::sqrt(variance) * kDegrees * 3600);
  text += "TIME_SYSTEM = UTC\nPARTICIPANT_1 = " + histories.spacecraft + "\n";
  text += format("PARTICIPANT_2 = OBJECT-%05u\n", number);
  text +=
      "MODE = SEQUENTIAL\nPATH = 2,1\nANGLE_TYPE = RADEC\nREFERENCE_FRAME = EME2000\nMETA_STOP\nDATA_START\n";
  for (const Bearing& bearing : object.bearings) {
    const std::string time = utc_text(epoch, bearing.time_ns - histories.first_time_ns);
    const double ra = std::atan2(bearing.direction.y(), bearing.direction.x()) * kDegrees;
    const double dec = std::asin(std::clamp(bearing.direction.z(), -1.0, 1.0)) * kDegrees;
    text += format("ANGLE_1 = %s %.6f\n", time.c_str(), ra < 0 ? ra + 360 : ra);
    text += format("ANGLE_2 = %s %+.6f\n", time.c_str(), dec);
  }
  return text + "DATA_STOP\n";
}

}  // namespace

double ObjectHistory::arc() const {
  return bearings.empty() ? 0 : angle_between(bearings.front().direction, bearings.back().direction);
}

double ObjectHistory::mean_rate() const {
  if (bearings.size() < 2) return 0;
  return arc() / (1e-9 * static_cast<double>(bearings.back().time_ns - bearings.front().time_ns));
}

ObjectHistories read_object_histories(const std::string& path) {
  Recording recording(path);
  ObjectHistories histories;
  bool any = false;
  recording.for_each<omma_UnknownObjects>([&](const omma_UnknownObjects& sample) {
    if (!any) histories.first_time_ns = sample.time_ns;
    any = true;
    for (std::uint32_t i = 0; i < sample.objects._length; ++i) {
      const omma_UnknownObject& object = sample.objects._buffer[i];
      ObjectHistory& history = histories.objects[object.number];
      history.newest = object;
      if (!object.seen) continue;
      const double* covariance = object.covariance_bearing_rad2;
      const double trace = covariance[0] + covariance[4] + covariance[8];
      history.bearings.push_back({sample.time_ns, vector(object.bearing), std::sqrt(0.5 * trace)});
      history.cameras |= object.cameras;
    }
  });
  histories.spacecraft = recording.spacecraft();
  if (!any) throw InputError(path, 0, "unknown_objects", "a sample at least", "none");
  return histories;
}

std::string tracking_data_message(const ObjectHistories& histories, double epoch,
                                  const std::string& created) {
  std::string text = "CCSDS_TDM_VERS = 2.0\nCREATION_DATE = " + created + "\nORIGINATOR = OMMA\n";
  for (const auto& [number, object] : histories.objects)
    if (!object.bearings.empty()) text += segment(histories, number, object, epoch);
  return text;
}

}  // namespace omma::ground
