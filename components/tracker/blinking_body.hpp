// A body found by the blinking codes of its lights: followed through each camera's images while it is lost,
// its lights tell over some thirty frame sets which they are, and four of them give its pose without a start.
// For bodies whose pattern is symmetric, or too sparse to tell anything. docs/algorithms/blink_codes.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/estimation/least_squares.hpp"
#include "components/tracker/blink_codes.hpp"
#include "components/tracker/blink_tracks.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"

namespace omma {

/// Whether enough of the body's targets blink for it to be found by them.
bool blinks(const TargetBody& body) noexcept;

/// Holds its tracks (half a megabyte): on the heap. Nothing is allocated after construction.
class BlinkingBody {
 public:
  /// @param body  blinks; outlives this
  explicit BlinkingBody(const TargetBody& body);

  /// One frame set in which the body is lost. Follows the dots nobody has claimed and, where enough of them
  /// have told their code, gives the pairs and the pose.
  /// @param frame  of the trigger: what the codes are counted in
  /// @return whether it was found; `out.pairs` and `out.rig_from_body` are then its
  bool look(std::uint64_t frame, SeenDots& dots, BodyPairings& out) noexcept;

  /// One frame set in which the body is known: its lights are followed on, so that it is found at once when
  /// it is lost.
  /// @param body  its pairs, which have claimed their dots
  void watch(std::uint64_t frame, SeenDots& dots, const BodyPairings& body) noexcept;

 private:
  void follow(std::uint64_t frame, SeenDots& dots, std::size_t camera) noexcept;
  void tell(const SeenDots& dots, std::size_t camera, BodyPairings& out) noexcept;

  const TargetBody& body_;
  std::vector<std::uint16_t> target_of_code_;
  BlinkDecoder decoder_;
  std::vector<BlinkTracks> tracks_;  // a camera each
  StaticVector<Eigen::Vector2d, limits::kDotsPerCamera> places_;
  StaticVector<std::uint16_t, limits::kDotsPerCamera> dot_of_place_;
  static constexpr std::size_t kMostHistories = 96;  // decoded at most, the longest followed first
  StaticVector<BlinkHistory, kMostHistories> histories_;
  StaticVector<std::uint16_t, kMostHistories> track_of_history_;
  std::array<BlinkIdentity, kMostHistories> identities_{};
  StaticVector<Sight, limits::kTargetPairs> sights_;
  std::array<std::uint8_t, limits::kTargetPairs> used_{};
};

}  // namespace omma
