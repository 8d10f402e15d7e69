// The folder of one captured camera: <top>/<camera>/<camera>_<n>.png, the form that recordings are played
// from, and <camera>.csv with number, stamp and the device's own count of each frame.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "hal/live/live_camera.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {

/// The stamp of the first frame of all cameras, from which their numbers are counted alike.
class CaptureStart {
 public:
  TimeNs of(TimeNs first) noexcept {
    TimeNs unknown = 0;
    return start_ns_.compare_exchange_strong(unknown, first) ? first : unknown;
  }

 private:
  std::atomic<TimeNs> start_ns_{0};
};

/// Frame numbers of one camera: the first by time, so that frames of one instant have one number in every
/// folder; then as the device counts, so that a frame it lost is a number that is not there.
class FrameNumbers {
 public:
  /// @param period_ns  from one frame to the next; 0: not known, every camera begins with 0
  FrameNumbers(CaptureStart& start, TimeNs period_ns) : start_(start), period_ns_(period_ns) {}
  std::uint64_t number(TimeNs time_ns, std::uint32_t sequence);

 private:
  std::uint64_t by_time(TimeNs time_ns) const;

  CaptureStart& start_;
  TimeNs period_ns_;
  TimeNs start_ns_ = 0;
  std::optional<std::uint64_t> last_;
  std::uint32_t last_sequence_ = 0;
};

class FrameFolder {
 public:
  /// @throws InputError where the folder cannot be made or has frames of that camera already
  FrameFolder(const std::filesystem::path& top, const std::string& camera, PngEffort effort);
  /// @throws InputError where the disk does not take it
  void write(std::uint64_t number, const LiveFrame& frame);
  std::uint64_t frames() const { return frames_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path folder_;
  std::string camera_;
  PngEffort effort_;
  std::ofstream index_;
  std::ofstream exposures_;  // opened by the first frame whose exposure is known
  std::uint64_t frames_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace omma::ground
