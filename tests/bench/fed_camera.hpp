// A simulated camera for as long as it lives: a thread that writes frames of a noisy night sky into shared
// memory at a rate, as a device would give them, whoever takes them.
#pragma once

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "fsw/kernel/clock.hpp"
#include "ground/capture/capture_options.hpp"
#include "hal/shared_frames/shared_frames.hpp"

namespace omma {

class FedCamera {
 public:
  FedCamera(const std::string& name, int width, int height, int bits, double rate_hz)
      : camera_{name, "simulated", setup(name, width, height, bits, rate_hz)},
        writer_(camera_.setup.device, shape_of(camera_.setup)),
        feeder_([this] { feed(); }) {}
  ~FedCamera() {
    ends_.store(true);
    feeder_.join();
  }
  FedCamera(const FedCamera&) = delete;
  FedCamera& operator=(const FedCamera&) = delete;

  /// To capture it.
  const ground::CaptureCamera& camera() const { return camera_; }
  std::uint32_t frames() const { return frames_.load(); }

 private:
  static CameraSetup setup(const std::string& name, int width, int height, int bits, double rate_hz) {
    return {.where = "simulated camera",
            .device = name + "-" + std::to_string(::getpid()),
            .format = bits > 8 ? "Y16" : "GREY",
            .width = width,
            .height = height,
            .frame_rate_hz = rate_hz,
            .bits = bits,
            .timeout_ms = 60'000};
  }

  std::vector<std::byte> sky() const {
    const GreyShape shape = shape_of(camera_.setup);
    std::vector<std::byte> pixels(shape.bytes());
    std::minstd_rand random(7);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      pixels[i] =
          shape.white_level > 255 && i % 2 == 1 ? std::byte{0} : static_cast<std::byte>(random() % 24);
    return pixels;
  }

  void feed() {
    const std::vector<std::byte> pixels = sky();
    const auto period =
        std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / camera_.setup.frame_rate_hz));
    MonotonicClock clock;
    auto due = std::chrono::steady_clock::now();
    while (!ends_.load()) {
      writer_.write(pixels.data(), clock.now());
      frames_.fetch_add(1);
      std::this_thread::sleep_until(due += period);
    }
  }

  ground::CaptureCamera camera_;
  SharedFramesWriter writer_;
  std::atomic<std::uint32_t> frames_{0};
  std::atomic<bool> ends_{false};
  std::thread feeder_;
};

}  // namespace omma
