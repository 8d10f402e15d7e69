#include "components/catalogue/observer.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr std::string_view kUtcForm = "UTC as YYYY-MM-DDThh:mm:ss, years 1900 to 2100";

[[noreturn]] void refuse_epoch(std::string_view text) {
  throw InputError("--epoch", 0, "epoch", kUtcForm, "\"" + std::string(text) + "\"");
}

/// Takes exactly `digits` digits from the front of `rest`; false when they are not there.
bool take_digits(std::string_view& rest, int digits, int& value) {
  if (rest.size() < static_cast<std::size_t>(digits)) return false;
  value = 0;
  for (int i = 0; i < digits; ++i) {
    const char c = rest[static_cast<std::size_t>(i)];
    if (c < '0' || c > '9') return false;
    value = 10 * value + (c - '0');
  }
  rest.remove_prefix(static_cast<std::size_t>(digits));
  return true;
}

bool take(std::string_view& rest, char c) {
  if (rest.empty() || rest.front() != c) return false;
  rest.remove_prefix(1);
  return true;
}

int days_in_month(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month == 2 && leap ? 29 : kDays[month - 1];
}

/// Takes "hh:mm", "hh:mm:ss" or "hh:mm:ss.sss"; false when malformed.
bool take_time(std::string_view& rest, double& seconds_of_day) {
  int hour = 0;
  int minute = 0;
  int second = 0;
  double fraction = 0;
  if (!take_digits(rest, 2, hour) || !take(rest, ':') || !take_digits(rest, 2, minute)) return false;
  if (take(rest, ':')) {
    if (!take_digits(rest, 2, second)) return false;
    if (take(rest, '.')) {
      double unit = 0.1;
      int digit = 0;
      if (rest.empty() || rest.front() < '0' || rest.front() > '9') return false;
      while (take_digits(rest, 1, digit)) {
        fraction += unit * digit;
        unit *= 0.1;
      }
    }
  }
  if (hour > 23 || minute > 59 || second > 60) return false;  // 60: a leap second
  seconds_of_day = hour * 3600 + minute * 60 + second + fraction;
  return true;
}

}  // namespace

double julian_date(int year, int month, double day) noexcept {
  if (month <= 2) {
    year -= 1;
    month += 12;
  }
  const int century = year / 100;
  const int gregorian = 2 - century + century / 4;
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + gregorian - 1524.5;
}

namespace {

struct UtcDate {
  int year = 0;
  int month = 0;
  int day = 0;
  double seconds = 0;  // of the day
};

UtcDate parse_utc_date(std::string_view text) {
  std::string_view rest = text;
  int year = 0;
  int month = 0;
  int day = 0;
  if (!take_digits(rest, 4, year) || !take(rest, '-') || !take_digits(rest, 2, month) || !take(rest, '-') ||
      !take_digits(rest, 2, day)) {
    refuse_epoch(text);
  }
  if (year < 1900 || year > 2100 || month < 1 || month > 12 || day < 1 || day > days_in_month(year, month)) {
    refuse_epoch(text);
  }
  double seconds = 0;
  if ((take(rest, 'T') || take(rest, ' ')) && !take_time(rest, seconds)) refuse_epoch(text);
  take(rest, 'Z');
  if (!rest.empty()) refuse_epoch(text);
  return {year, month, day, seconds};
}

}  // namespace

double parse_utc(std::string_view text) {
  const UtcDate date = parse_utc_date(text);
  return julian_date(date.year, date.month, date.day + date.seconds / 86400.0);
}

std::int64_t parse_utc_ns(std::string_view text) {
  const UtcDate date = parse_utc_date(text);
  const std::chrono::sys_days day = std::chrono::year(date.year) / date.month / date.day;
  constexpr std::int64_t kMicrosecondsPerDay = 86'400'000'000;
  const std::int64_t microseconds =
      day.time_since_epoch().count() * kMicrosecondsPerDay + std::llround(date.seconds * 1e6);
  return microseconds * 1000;
}

GroundSite parse_ground_site(std::string_view text) {
  constexpr double kDegree = std::numbers::pi / 180;
  double value[3] = {0, 0, 0};
  int count = 0;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  bool good = false;
  while (count < 3) {
    if (at != end && *at == '+') ++at;
    const auto [next, error] = std::from_chars(at, end, value[count]);
    if (error != std::errc{}) break;
    ++count;
    good = next == end;
    if (good || *next != ',') break;
    at = next + 1;
  }
  const bool ranges =
      std::abs(value[0]) <= 90 && std::abs(value[1]) <= 360 && value[2] >= -500 && value[2] <= 9000;
  if (!good || count < 2 || !ranges) {
    throw InputError("--site", 0, "site",
                     "LAT,LON,HEIGHT in degrees (north and east positive) and metres (-500 to 9000)",
                     "\"" + std::string(text) + "\"");
  }
  return {value[0] * kDegree, value[1] * kDegree, value[2], std::nullopt, std::nullopt};
}

}  // namespace omma
