// Star identification, lost in space: which dot is which star, and the attitude, from the dots of all cameras
// jointly. Works on bearings: fields from 10° to the whole sky, one or many cameras, one or two stars in
// each.
//
// Two bright dots are taken to be each pair of catalogue stars at their angle in turn; each such hypothesis
// is an attitude, which the other dots confirm or not (sky_evidence.hpp). Accepted when the probability of a
// false match, over all hypotheses tried, is below a bound. No answer is an answer.
// Mathematics, proof of the bound and figures: docs/algorithms/identification.md.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "components/catalogue/star_catalogue.hpp"
#include "components/geometry/rig_dot.hpp"
#include "components/tracker/search_order.hpp"
#include "components/tracker/sky_coverage.hpp"
#include "components/tracker/sky_evidence.hpp"
#include "components/tracker/sparse_sky.hpp"
#include "components/tracker/star_matching.hpp"
#include "components/tracker/star_pairs.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

enum class IdentificationStatus : std::uint8_t {
  kIdentified,
  kTooFewDots,   ///< fewer than four dots, or so few that no match could be told from chance
  kNotVerified,  ///< every hypothesis the dots allow was tried and none explains them
  kSearchCut,    ///< the same, but the hypothesis limit came first
  kMirrored,     ///< the sky is there, seen in a mirror: the image or the lens file is flipped
};

/// One clause for an operator, for instance "no hypothesis verified".
const char* reason(IdentificationStatus status) noexcept;

struct IdentificationParameters {
  double false_match_probability = 1e-7;   ///< bound, over all hypotheses tried for one set of dots
  std::uint32_t hypothesis_limit = 60000;  ///< bound on the work
  std::uint32_t aided_limit = 16000;       ///< the same of an aided search
  bool names_mirrored = true;  ///< when nothing fits, look whether a mirror image would (half the work again)
};

struct Identification {
  IdentificationStatus status = IdentificationStatus::kTooFewDots;
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< small rotation, rig frame [rad²]
  StaticVector<StarMatch, limits::kStarPairs> matches;   ///< empty unless identified
  double widening = 1;           ///< factor every dot's sigma needed for the lens to be believed
  double rms = 0;                ///< angle between dots and their stars [rad]
  std::uint32_t hypotheses = 0;  ///< tried, all passes
  double log10_false_match = 0;  ///< of the proven bound on the probability that this answer is false
};

/// Holds its tables and scratch space (2 MB): keep it in static storage or on the heap, not on the stack.
class StarIdentification {
 public:
  /// Builds the table of pairs (start-up; 5 to 60 ms). @param catalogue must outlive this
  StarIdentification(const StarCatalogue& catalogue, const SkyCoverage& coverage,
                     const IdentificationParameters& parameters = {}) noexcept;

  /// The tables again after the catalogue was rebuilt (another epoch).
  void rebuild() noexcept { pairs_.build(catalogue_, coverage_); }

  /// @param dots  of all cameras, any order; sigma must include what the lens calibration does not know
  void identify(std::span<const RigDot> dots, Identification& result) noexcept;

  /// Aided: the attitude is known to within an angle. Only hypotheses inside it are tried, so that fewer
  /// stars suffice for the same bound. No mirror images.
  /// @param largest_angle  between the prior attitude and the true one [rad]
  void identify_near(const Eigen::Quaterniond& rig_from_j2000, double largest_angle,
                     std::span<const RigDot> dots, Identification& result) noexcept;

  /// Aided by where an axis of the rig points; the roll about it is not known.
  /// @param axis       unit, rig frame; `direction` unit, J2000
  /// @param largest_angle  between the direction and where the axis truly points [rad]
  void identify_pointing(const Eigen::Vector3d& axis, const Eigen::Vector3d& direction, double largest_angle,
                         std::span<const RigDot> dots, Identification& result) noexcept;

  const StarPairs& pairs() const { return pairs_; }

 private:
  struct Pass {
    DotOrder order;
    double widening;  // of every dot's sigma, for lenses worse than they say
    double work;      // part of the hypothesis limit
    double part;      // of the probability of a false match
  };
  struct DotPair {
    std::size_t first;  // in the order of the search
    std::size_t second;
    double part;  // of the probability of a false match
  };

  bool search(std::span<const RigDot> dots, const Pass& pass, double until, Identification& result) noexcept;
  bool try_pair(std::span<const SearchDot> order, const DotPair& pair, double until,
                Identification& result) noexcept;
  template <class Visit>
  bool each_hypothesis(std::span<const SearchDot> order, const DotPair& pair,
                       std::span<const StarPair> candidates, Visit&& visit) noexcept;
  double weigh_hypotheses(std::span<const SearchDot> order, const DotPair& pair,
                          std::span<const StarPair> candidates) noexcept;
  double weight_of(std::size_t hypothesis) const noexcept;
  bool take(std::span<const SearchDot> order, double ratio, double part, Identification& result) noexcept;
  bool mirrored(std::span<const RigDot> dots, Identification& result) noexcept;

  const StarCatalogue& catalogue_;
  SkyCoverage coverage_;
  IdentificationParameters parameters_;
  StarPairs pairs_;
  SearchOrder order_;
  SparseSky sparse_;
  SkyEvidence evidence_;
  StarMatching matching_;
  std::array<RigDot, limits::kDotsPerCamera> mirror_;
  /// A hypothesis M = j2000_from_rig is tried where Σ Mᵢⱼ weightᵢⱼ ≥ least. Of an attitude P the sum is the
  /// trace of PᵀM, 1 + 2 cos of the angle between them; of an axis a and a direction d, weight d aᵀ, it is d
  /// · M a.
  struct Prior {
    Eigen::Matrix3d weight;
    double least;
    double fraction;  // of all attitudes that it lets pass
    std::optional<double>
        least_cosine;  // the weight is an attitude: between where it sees a dot and its star
  };
  void identify_aided(const Prior& prior, std::span<const RigDot> dots, Identification& result) noexcept;
  bool search_all(std::span<const RigDot> dots, double limit, Identification& result) noexcept;
  std::optional<Prior> prior_;
  std::array<double, 4096> weights_{};  // of the first hypotheses of two dots
  std::size_t weighed_ = 0;
  double tried_ = 0;  // hypotheses and the table entries looked at for them, in units of one hypothesis
};

}  // namespace omma
