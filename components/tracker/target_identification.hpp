// Identifies the targets of one body in an unlabelled cloud of dots, among stars and clutter, from the
// pattern of the targets alone: lost in space, but for a docking card or a spacecraft face.
//
// Four neighbouring dots of one camera are compared with all local foursomes of targets by affine coordinates
// (a small patch is seen almost in parallel projection; Huttenlocher & Ullman 1990, Lamdan & Wolfson 1988),
// the survivors by the exact three-point pose, the best of them by the number of targets they explain in all
// cameras. An answer is given only when that number cannot be chance, and no other labelling explains as
// much. Work is bounded, nothing is allocated after construction, the same dots give the same answer.
// docs/algorithms/target_identification.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/estimation/least_squares.hpp"
#include "components/geometry/rig_dot.hpp"

namespace omma {

enum class TargetIdentificationStatus : std::uint8_t {
  kNone,
  kIdentified,
  kTooFewDots,     ///< no camera has four dots
  kTooFewTargets,  ///< the body has fewer than four targets
  kNoMatch,        ///< no labelling explains enough dots to rule out chance
  kAmbiguous,      ///< several labellings explain the dots equally well (a symmetric pattern)
  kWorkLimit,      ///< the bound on work was reached before an answer
};

struct TargetPair {
  std::uint16_t dot = 0;     ///< index in the span given to identify
  std::uint16_t target = 0;  ///< index in the body
};

struct TargetIdentification {
  TargetIdentificationStatus status = TargetIdentificationStatus::kNone;
  PoseSolution
      pose;  ///< refined over all pairs; `pose.ambiguous` where a flat card's mirror image fits as well
  StaticVector<TargetPair, limits::kTargetPairs> pairs;
  double log_chance = 0;         ///< ln of the expected number of such matches among dots strewn at random
  std::uint32_t foursomes = 0;   ///< of dots, tried
  std::uint32_t hypotheses = 0;  ///< poses computed
  std::uint32_t verified = 0;    ///< poses carried to all dots
};

struct TargetIdentifierOptions {
  double gate = 4.0;                 ///< a target is explained by a dot this near [σ]
  double largest_log_chance = -6.9;  ///< ln of the expected number of chance matches accepted (1e-3)
  double least_part = 0.4;           ///< of the targets that must be explained
  double tilt_factor = 1.5;  ///< tan of the largest tilt of the card that the patch comparison allows for
  std::uint32_t most_foursomes = 400;
  std::uint32_t most_hypotheses = 20000;
  std::uint32_t most_comparisons = 50000;  ///< of foursomes of dots with triples of a solid body's targets
};

class TargetIdentifier {
 public:
  explicit TargetIdentifier(const TargetBody& body, const TargetIdentifierOptions& options = {});
  ~TargetIdentifier();
  TargetIdentifier(TargetIdentifier&&) noexcept;
  TargetIdentifier& operator=(TargetIdentifier&&) noexcept;

  /// @param dots  of all cameras, those of one camera one after the other, brightest first
  ///              (at most kMostDots of each camera are looked at)
  TargetIdentification identify(std::span<const RigDot> dots) noexcept;

  static constexpr std::size_t kMostDots = 256;  ///< of one camera, whose neighbourhoods are searched

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace omma
