// Lights followed from frame to frame through the frames in which they are dark, in one camera's image, with
// what was seen of each: the input of the decoder of blinking codes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "components/tracker/blink_codes.hpp"
#include "config/limits.hpp"

namespace omma {

struct BlinkTrack {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< in the newest frame; where dark, predicted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [px a frame]
  BlinkHistory history;
  int dark = 0;  ///< frames seen in a row in which it was dark
  int age = 0;   ///< frames since it began
  int dot = -1;  ///< in the newest frame; −1: dark
};

struct BlinkTracksOptions {
  double gate_px = 3;         ///< farthest from where it is predicted, of a track that has a velocity
  double first_gate_px = 12;  ///< of a young one
  int most_dark = 3;          ///< in a row; then the track ends
};

class BlinkTracks {
 public:
  static constexpr std::size_t kCapacity = limits::kDotsPerCamera;

  explicit BlinkTracks(const BlinkTracksOptions& options = {}) : options_(options) {}

  /// @param frame  of the trigger: frames left out are unknown, not dark
  /// @param dots   centres [px], brightest first
  void step(std::uint64_t frame, std::span<const Eigen::Vector2d> dots) noexcept;

  std::span<const BlinkTrack> tracks() const { return {tracks_.data(), count_}; }

 private:
  void predict(int frames) noexcept;
  void update(BlinkTrack& track, const Eigen::Vector2d& seen, int frames) const noexcept;

  BlinkTracksOptions options_;
  std::array<BlinkTrack, kCapacity> tracks_{};
  std::size_t count_ = 0;
  bool started_ = false;
  std::uint64_t frame_ = 0;
};

}  // namespace omma
