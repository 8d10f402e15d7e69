// LightCandidates: the lights of the sky that may be a body's, a bounded number of them followed at once: the
// brightest unknown objects that do not turn with the rig, each with the growth of its brightness since it
// was taken in. One that comes nearer is a body that approaches, however faint; of those that do not tell,
// the brightest is the likeliest. A bright one that is seen now and then is none: a star that is not always
// known.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "components/approach/light_growth.hpp"
#include "components/surveillance/unknown_objects.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

struct LightCandidate {
  std::uint32_t number = 0;  ///< of the unknown object
  TimeNs since_ns = 0;
  TimeNs seen_ns = 0;
  bool seen = false;      ///< in this frame set
  bool followed = false;  ///< a body's light: stays
  double flux = 0;        ///< when it was seen last [grey levels]
  double snr = 0;         ///< the same
  double often = 1;       ///< share of the frame sets in which it was seen, a running mean
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< J2000
  LightGrowth growth;

  /// Seen as often as its brightness lets one expect.
  bool is_steady() const noexcept;
};

/// What one frame set says of one object's light.
struct CandidateLight {
  double log_brightness = 0;  ///< free of exposure and lens
  double sigma = 0;           ///< of it; 0: not told
};

class LightCandidates {
 public:
  static constexpr std::size_t kMost = 8;

  /// @param number  followed at once beside those that are a body's light already, up to kMost
  explicit LightCandidates(int number) noexcept
      : number_(std::min(static_cast<std::size_t>(number), kMost)) {}

  /// A new frame set: every object of the sky is shown once.
  void begin(TimeNs time_ns) noexcept;
  void show(const UnknownObject& object, const CandidateLight& light, bool followed) noexcept;
  /// Those not seen for long are let go.
  void end() noexcept;

  /// The likeliest of those `admitted` (a LightCandidate → bool), seen in this frame set; null: none.
  template <class Admitted>
  const LightCandidate* best(Admitted&& admitted) const noexcept {
    const LightCandidate* found = nullptr;
    for (const LightCandidate& one : lights_)
      if (one.seen && one.is_steady() && admitted(one) && (found == nullptr || likelier(one, *found)))
        found = &one;
    return found;
  }
  const LightCandidate* find(std::uint32_t number) const noexcept;
  std::size_t size() const noexcept { return lights_.size(); }

  /// Whether `one` comes nearer while `other` does not, or not so fast, beyond doubt.
  static bool outgrows(const LightCandidate& one, const LightCandidate& other) noexcept;

 private:
  LightCandidate* place_for(double flux) noexcept;
  static bool likelier(const LightCandidate& one, const LightCandidate& other) noexcept;

  std::size_t number_;
  TimeNs time_ns_ = 0;
  TimeNs interval_ns_ = 0;  // from the frame set before to this one
  StaticVector<LightCandidate, kMost + limits::kTargetBodies> lights_;
};

}  // namespace omma
