// A live camera: a thread of its own waits for the device's frames, converts them into a ring and opens the
// device again after a loss; `grab` takes the frame whose stamp belongs to the trigger, and never waits.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "fsw/kernel/triple_buffer.hpp"
#include "hal/camera.hpp"
#include "hal/live/frame_phase.hpp"
#include "hal/live/frame_source.hpp"

namespace omma {

/// A frame as it came, for those who want every one of them.
struct LiveFrame {
  ImageView image;  ///< valid until the next `next`
  TimeNs time_ns = 0;
  std::uint32_t sequence = 0;
  CameraSettings settings{};  ///< those it was taken with, as far as the driver knows
};

class LiveCamera final : public CameraDriver {
 public:
  /// Starts the device and the thread.
  /// @param phase       shared by the live cameras of a rig
  /// @param timeout_ms  silence after which the stream is started anew
  /// @param slots       frames of room, the one in use included; 2 ... 256
  /// @param priority    of the thread: SCHED_FIFO 1 ... 99, best above the steps', which may be long; or 0
  /// @throws InputError as FrameSource::start does
  LiveCamera(std::unique_ptr<FrameSource> source, std::shared_ptr<FramePhase> phase, int timeout_ms,
             std::uint32_t slots = 6, int priority = 0);
  ~LiveCamera() override;
  LiveCamera(const LiveCamera&) = delete;
  LiveCamera& operator=(const LiveCamera&) = delete;

  std::string_view driver_name() const override { return source_->driver_name(); }
  CameraHealth health() const noexcept override;
  /// Fresh: the frame whose age at `trigger_time_ns` lies in the interval of the phase, its number the
  /// trigger's and its midpoint the device's stamp. Late: only an older one came. Wait-free.
  Frame grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept override;
  CameraSettingsRange settings_range() const noexcept override { return range_; }
  /// Handed to the thread, which sets it before the next frame; after a loss, again.
  SettingsResult apply(const CameraSettings& settings) noexcept override;

  /// The oldest frame not taken yet, whatever its time; none where there is none. Instead of `grab`, not
  /// beside it.
  std::optional<LiveFrame> next() noexcept;
  const GreyShape& shape() const { return shape_; }

 private:
  struct Slot {
    std::vector<std::byte> pixels;
    TimeNs time_ns = 0;
    std::uint32_t sequence = 0;
    CameraSettings settings;
  };

  void watch();
  void set_what_was_asked();
  void take_one();
  void lose();
  void reopen();
  void keep_spare(const Taken& taken);
  void count_gap(std::uint32_t sequence);
  ImageView view(const Slot& slot) const;
  bool release_and_peek() noexcept;
  Slot& slot(std::uint32_t count) { return slots_[count % slots_.size()]; }

  std::unique_ptr<FrameSource> source_;
  std::shared_ptr<FramePhase> phase_;
  GreyShape shape_;
  int timeout_ms_;
  int priority_;

  // A ring with one writer (the thread counts filled_ up) and one reader (grab counts released_ up); the
  // frame in use is the oldest one. The writer never waits: it takes every frame into spare_, which changes
  // places with the next free slot where there is one.
  std::vector<Slot> slots_;
  Slot spare_;
  std::atomic<std::uint32_t> filled_{0};
  std::atomic<std::uint32_t> released_{0};
  bool in_use_ = false;  // the reader's: the oldest slot was handed out

  CameraSettingsRange range_;               // of the device as it was at the start
  TripleBuffer<CameraSettings> asked_;      // from who grabs to the thread
  std::optional<CameraSettings> settings_;  // the thread's: asked for until now
  std::atomic<bool> refused_{false};        // the device did not take the last ones

  std::optional<std::uint32_t> last_sequence_;  // the thread's
  int silent_ms_ = 0;
  bool open_ = true;

  std::atomic<bool> wanted_{false};  // what is lost before the first frame is asked for is no loss
  std::atomic<bool> connected_{true};
  std::atomic<std::uint32_t> delivered_{0};
  std::atomic<std::uint32_t> gaps_{0};
  std::atomic<std::uint32_t> damaged_{0};
  std::atomic<std::uint32_t> unmatched_{0};
  std::atomic<std::uint32_t> overrun_{0};
  std::atomic<std::uint32_t> losses_{0};

  std::mutex pause_mutex_;  // the thread's pauses between attempts to open the device, cut short at the end
  std::condition_variable pause_;
  bool stop_ = false;
  std::thread watcher_;
};

}  // namespace omma
