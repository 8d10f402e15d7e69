#include "components/tracker/blink_tracks.hpp"

#include <algorithm>
#include <limits>

namespace omma {
namespace {

constexpr int kYoung = 4;  // frames until the velocity can be relied on
// Gains of a filter for constant velocity (Kalata's α–β at a tracking index of about one).
constexpr double kPositionGain = 0.7, kVelocityGain = 0.4;

}  // namespace

void BlinkTracks::predict(int frames) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    BlinkTrack& track = tracks_[i];
    track.pixel += frames * track.velocity;
    track.age += frames;
    track.dot = -1;
    if (frames >= 64) {
      track.history = {};
    } else {
      track.history.lit <<= frames;
      track.history.known <<= frames;
    }
    track.history.known |= 1;
  }
}

void BlinkTracks::update(BlinkTrack& track, const Eigen::Vector2d& seen, int frames) const noexcept {
  const Eigen::Vector2d off = seen - track.pixel;
  const bool second = track.age == frames;  // the first step after its first dot gives the velocity whole
  track.velocity += (second ? 1.0 : kVelocityGain) * off / frames;
  track.pixel += (second ? 1.0 : kPositionGain) * off;
  track.history.lit |= 1;
  track.dark = 0;
}

void BlinkTracks::step(std::uint64_t frame, std::span<const Eigen::Vector2d> dots) noexcept {
  const bool forward = started_ && frame > frame_;
  if (!forward) count_ = 0;
  const int frames = forward ? static_cast<int>(std::min<std::uint64_t>(frame - frame_, 64)) : 1;
  started_ = true;
  frame_ = frame;
  predict(frames);

  // Brightest first, each dot to the nearest track that has none yet.
  const std::size_t before = count_;
  for (std::size_t d = 0; d < dots.size() && d < kCapacity; ++d) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t found = before;
    for (std::size_t i = 0; i < before; ++i) {
      const BlinkTrack& track = tracks_[i];
      if (track.dot >= 0) continue;
      const double gate = track.age > kYoung ? options_.gate_px : options_.first_gate_px;
      const double distance2 = (dots[d] - track.pixel).squaredNorm();
      if (distance2 < gate * gate * frames && distance2 < nearest) {
        nearest = distance2;
        found = i;
      }
    }
    if (found < before) {
      update(tracks_[found], dots[d], frames);
      tracks_[found].dot = static_cast<int>(d);
    } else if (count_ < kCapacity) {
      BlinkTrack& fresh = tracks_[count_++];
      fresh = {};
      fresh.pixel = dots[d];
      fresh.history = {1, 1};
      fresh.dot = static_cast<int>(d);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    BlinkTrack& track = tracks_[i];
    track.dark += track.dot < 0 ? 1 : 0;
    if (track.dark <= options_.most_dark) tracks_[kept++] = track;
  }
  count_ = kept;
}

}  // namespace omma
