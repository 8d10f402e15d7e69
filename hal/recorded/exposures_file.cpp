#include "hal/recorded/exposures_file.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>

#include "fsw/kernel/input_error.hpp"

namespace omma {

std::map<std::uint64_t, CameraSettings> read_exposures(const std::filesystem::path& file) {
  std::map<std::uint64_t, CameraSettings> exposures;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return exposures;
  std::ifstream in(file);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (line == 1 && text == kExposuresHeading) continue;
    const auto refuse = [&](const char* field, const char* expected, const std::string& found) {
      throw InputError(file.string(), line, field, expected, found);
    };
    unsigned long long number = 0;
    double exposure_ms = 0;
    double gain = 0;
    double black = 0;
    int end = 0;
    const int read =
        std::sscanf(text.c_str(), "%llu,%lf,%lf,%lf%n", &number, &exposure_ms, &gain, &black, &end);
    if (read != 4 || static_cast<std::size_t>(end) != text.size()) refuse("line", kExposuresHeading, text);
    if (!(exposure_ms > 0 && exposure_ms <= 1e6)) refuse("exposure_ms", "above 0, to 1000000", text);
    if (!(gain > 0 && gain <= 1e6)) refuse("gain", "above 0, to 1000000", text);
    if (!(black >= 0 && black <= 65535)) refuse("black_level", "a grey level, 0 to 65535", text);
    const CameraSettings settings{.exposure_ns = std::llround(1e6 * exposure_ms),
                                  .gain = static_cast<float>(gain),
                                  .black_level = static_cast<float>(black)};
    if (!exposures.emplace(number, settings).second)
      refuse("number", "each frame once", std::to_string(number) + " again");
  }
  return exposures;
}

std::string exposure_line(std::uint64_t number, const CameraSettings& settings) {
  char text[96];
  std::snprintf(text, sizeof text, "%llu,%.6f,%g,%g\n", static_cast<unsigned long long>(number),
                1e-6 * static_cast<double>(settings.exposure_ns), static_cast<double>(settings.gain),
                static_cast<double>(settings.black_level));
  return text;
}

}  // namespace omma
