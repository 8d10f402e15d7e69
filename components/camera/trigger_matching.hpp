// Which trigger exposed a frame, told by time. A camera that is fired by a line stamps its frames but does
// not number the pulses: one that lost a pulse, or delivered late, would otherwise shift all its frames by
// one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "fsw/kernel/tick.hpp"

namespace omma {

struct TriggerMatchOptions {
  static constexpr TimeNs kLearn = -1;
  /// From the trigger's edge to the frame's stamp; kLearn: as the first frame has it, taken for one of the
  /// newest trigger before its stamp.
  TimeNs delay_ns = kLearn;
  TimeNs tolerance_ns = 0;  ///< how far the stamp may lie from that; less than half a trigger period
};

enum class MatchKind : std::uint8_t {
  kOnTime,    ///< of the newest trigger
  kLate,      ///< of an earlier one
  kRepeated,  ///< of a trigger that has its frame already
  kStray,     ///< of none: no trigger within the tolerance
};

struct TriggerMatch {
  MatchKind kind = MatchKind::kStray;
  std::uint64_t number = 0;  ///< of the trigger; not for a stray frame
  TimeNs offset_ns = 0;      ///< how far the stamp lies from where it was expected; of the nearest trigger
  std::uint64_t behind = 0;  ///< triggers sent since that one
  std::uint64_t lost = 0;    ///< triggers between the last frame's and this one's that got no frame
};

/// The triggers of one camera and the frames they made. Nothing allocates, every call is bounded.
class TriggerMatching {
 public:
  static constexpr std::size_t kRemembered = 32;  ///< triggers; a frame of an older one is stray

  explicit TriggerMatching(TriggerMatchOptions options) : options_(options) {}

  /// A trigger was sent: numbers and times rise.
  void add_trigger(std::uint64_t number, TimeNs edge_ns) noexcept;
  /// A frame came. Its trigger is the one whose expected stamp is nearest.
  TriggerMatch match(TimeNs stamp_ns) noexcept;
  /// Triggers that have no frame and can have none any more: a frame of a later one has come.
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct Sent {
    std::uint64_t number = 0;
    TimeNs edge_ns = 0;
    bool has_frame = false;
  };
  void learn(TimeNs stamp_ns) noexcept;
  Sent& sent(std::uint64_t index) noexcept { return sent_[index % kRemembered]; }
  std::uint64_t first() const noexcept { return count_ > kRemembered ? count_ - kRemembered : 0; }

  TriggerMatchOptions options_;
  std::array<Sent, kRemembered> sent_{};
  std::uint64_t count_ = 0;       // triggers so far
  std::uint64_t next_frame_ = 0;  // index of the first trigger whose frame may still come in order
  std::uint64_t lost_ = 0;
};

}  // namespace omma
