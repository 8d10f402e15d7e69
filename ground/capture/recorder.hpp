// One camera being captured: a thread of its own takes every frame and writes it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <thread>

#include "ground/capture/capture_options.hpp"
#include "ground/capture/frame_folder.hpp"
#include "ground/capture/shown_frames.hpp"
#include "hal/live/live_camera.hpp"

namespace omma::ground {

struct RecorderOptions {
  std::string output;        ///< folder; empty: frames are only counted
  std::uint64_t frames = 0;  ///< that are wanted; 0: until it is stopped
  bool compress = false;
};

class Recorder {
 public:
  /// Opens the camera. @throws InputError as the camera's driver and FrameFolder do
  Recorder(const CaptureCamera& camera, const RecorderOptions& options, CaptureStart& start);
  ~Recorder() { stop(); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void start();
  /// What the device gave until now is still written.
  void stop();
  bool done() const { return done_.load(); }

  // While it runs, from any thread.
  const std::string& name() const { return name_; }
  const std::string& driver() const { return driver_; }
  const GreyShape& shape() const { return camera_->shape(); }
  CameraHealth health() const { return camera_->health(); }
  std::uint64_t taken() const { return taken_.load(); }
  std::uint64_t bytes() const { return bytes_.load(); }
  /// Frames a second over the last second or so, by the device's stamps; 0 where none came for that long.
  double newest_rate_hz() const;
  TimeNs exposure_ns() const { return exposure_ns_.load(); }  ///< of the newest frame; 0: not known
  float gain() const { return gain_.load(); }
  ShownFrames& shown() { return shown_; }

  // After it is done.
  const std::string& failure() const { return failure_; }
  /// Frames taken a second, by the device's stamps.
  double rate_hz() const;
  double seconds() const { return std::chrono::duration<double>(last_ - first_).count(); }
  /// Every frame that the device counted is there.
  bool complete() const;

 private:
  using Clock = std::chrono::steady_clock;

  void write();
  void keep(const LiveFrame& frame);
  void note_rate(TimeNs stamp_ns);

  std::string name_;
  std::string driver_;
  std::uint64_t frames_wanted_;
  FrameNumbers numbers_;
  std::unique_ptr<FrameFolder> folder_;
  std::unique_ptr<LiveCamera> camera_;
  Clock::time_point first_{}, last_{};
  TimeNs first_stamp_ns_ = 0, last_stamp_ns_ = 0;
  TimeNs rate_since_ns_ = 0;  // the second that is being counted began, and had so many frames
  std::uint64_t rate_frames_ = 0;
  std::atomic<double> newest_rate_hz_{0};
  std::atomic<Clock::rep> newest_at_{0};
  std::atomic<TimeNs> exposure_ns_{0};
  std::atomic<float> gain_{1};
  std::atomic<std::uint64_t> taken_{0};
  std::atomic<std::uint64_t> bytes_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> done_{false};
  std::string failure_;
  ShownFrames shown_;
  std::thread writer_;
};

using Recorders = std::list<Recorder>;

}  // namespace omma::ground
