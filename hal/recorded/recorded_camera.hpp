// Plays a recording as a camera: the frame of number n is that of the trigger n. A thread of its own reads
// ahead, because decoding allocates and takes milliseconds; `grab` only takes what lies ready.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "hal/camera.hpp"
#include "hal/recorded/frame_folder.hpp"
#include "hal/recorded/frame_store.hpp"

namespace omma {

/// What `grab` does where the frame exists but is not decoded yet.
enum class Playback : std::uint8_t {
  kLockstep,  ///< wait for it (a futex): the replay is complete and repeatable, as fast as the disk lets it
  kRealTime,  ///< report it missing: `grab` never waits
};

struct RecordedCameraOptions {
  Playback playback = Playback::kLockstep;
  int width = 0;   ///< every frame must have this width and height [px], the lens's; 0: any, but all the same
  int height = 0;  ///< [px]
  int bits = 0;    ///< 8 or 16, the same way
  std::uint16_t white_level = 0;  ///< of the sensor, where the files do not know it; 0: as the files say
  int rounds = 1;                 ///< how often the recording is played, one time after the other
  std::uint64_t round_length =
      0;  ///< frame numbers of one round, the same for all cameras; 0: up to the last
};

class RecordedCamera final : public CameraDriver {
 public:
  /// Looks at the header of every frame, sizes the buffers and starts reading ahead.
  /// @throws InputError: a frame that is not readable, or of another size or depth than the options or the
  /// first
  RecordedCamera(std::unique_ptr<FrameStore> store, const RecordedCameraOptions& options);
  /// The frames of a folder, <top>/<camera>. @throws InputError also as `find_frame_files`
  RecordedCamera(const std::filesystem::path& top, const std::string& camera,
                 const RecordedCameraOptions& options)
      : RecordedCamera(std::make_unique<FileFrames>(top / camera, camera), options) {}
  ~RecordedCamera() override;
  RecordedCamera(const RecordedCamera&) = delete;
  RecordedCamera& operator=(const RecordedCamera&) = delete;

  std::string_view driver_name() const override { return "recorded"; }
  /// True when the last frame has been asked for.
  bool at_end() const noexcept override { return asked_.load(std::memory_order_relaxed) > last_number(); }
  /// The exposure midpoint is the trigger's time: a recording holds no better one. Numbers must not fall; a
  /// smaller number than before is missing. A file that cannot be decoded is missing and counted. Real time:
  /// no wait; the only call to the system wakes the reading thread.
  Frame grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept override;

  std::uint64_t first_number() const noexcept { return frames_.front().number; }
  std::uint64_t last_number() const noexcept override { return frames_.back().number; }
  std::size_t frames() const noexcept { return frames_.size(); }
  /// Frames so far whose file could not be decoded (a torn file, a disk error).
  std::uint32_t unreadable() const noexcept { return unreadable_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::uint32_t kSlots = 4;  // frames read ahead, the one in use included

  struct Recorded {
    std::uint64_t number = 0;
    std::size_t index = 0;  // in the store
  };
  struct Slot {
    Image image;
    std::uint64_t number = 0;
    CameraSettings settings{};
    bool readable = false;
  };

  void check_headers(const RecordedCameraOptions& options) const;
  void list_frames(const RecordedCameraOptions& options);
  void read_ahead();
  void fill(Slot& slot, const Recorded& frame);
  bool wait_for_free_slot(std::uint32_t filled);

  std::unique_ptr<FrameStore> store_;  // the reading thread's, once it runs
  std::vector<Recorded> frames_;       // by rising number
  Playback playback_;
  std::uint16_t white_level_;
  // A ring with one writer (the reading thread counts filled_ up) and one reader (grab counts released_ up).
  // 32 bits, because that is what a futex waits on; both counters may wrap.
  std::array<Slot, kSlots> slots_;
  std::atomic<std::uint32_t> filled_{0};
  std::atomic<std::uint32_t> released_{0};
  std::atomic<std::uint64_t> asked_{0};  // one more than the largest number asked for
  std::atomic<std::uint32_t> unreadable_{0};
  std::atomic<bool> stop_{false};
  std::thread reader_;
};

}  // namespace omma
