#include "components/tracker/target_identification.hpp"

#include <algorithm>
#include <cmath>

#include "components/estimation/three_point_pose.hpp"
#include "components/tracker/dot_patches.hpp"
#include "components/tracker/target_patches.hpp"
#include "components/tracker/target_verification.hpp"

namespace omma {
namespace {

constexpr std::size_t kMostCandidates = 4096;  // foursomes of targets looked at for one foursome of dots
constexpr std::size_t kSolidCandidates = 4 * TargetPatches::kMostOfBlock;  // of a solid body at a time
constexpr std::size_t kMostSurvivors = 8;  // of one foursome, carried to all dots
// Odds from the dots around the patch: of a pose that is carried to all dots at once, and of one that is only
// where nothing else gave an answer. Right ones have a hundred and more, one in a thousand others has.
constexpr double kGoodOdds = 7, kLeastOdds = 0.2;
constexpr std::size_t kMostDoubtful = 64;
/// Two labellings whose log-odds differ by less may either be right (1 in 10⁴).
constexpr double kLabellingMargin = 9.2;
// Log-chance at which the search stops: of a labelling that explains all there is to explain, and of another.
constexpr double kBeyondDoubt = -12.0, kBeyondDoubtOfPart = -14.0;
// Foursomes looked at after the first credible labelling short of that: those that share dots with it, and
// others; few where it is beyond doubt but for what it leaves unexplained.
constexpr std::uint32_t kSecondLooks = 60, kFewLooks = 12, kLooksElsewhere = 8;
// Of the bound on chance matches: labellings that explain less than the usual part of the targets turned to
// the cameras, or four of more, get a thousandth of it (ln), for chance makes many of them and the body few.
constexpr double kUsualPart = 0.7, kShareOfFew = -6.9;
constexpr double kSamePose = 0.3;    // turned by so much at most, two poses of a patch are one [rad]
constexpr double kImprobable = 6.0;  // χ² this many of its standard deviations too large is not noise

/// Foursomes of targets that a foursome of dots is compared with.
enum class Kind : std::uint8_t { kPlanar, kSolid };
constexpr double kPartForFaces = 0.75;  // of all work, for foursomes of one face

struct Survivor {
  Pose pose;
  PatchEvidence::Hits hits;
  double odds = 0;             ///< that the dots around the patch make so good a pose not by chance
  std::uint32_t foursome = 0;  ///< from which it came
};

/// The best few, likeliest first; the earlier stays before the later.
template <std::size_t kCapacity>
void keep(const Pose& pose, const PatchEvidence::Found& found, std::uint32_t foursome,
          StaticVector<Survivor, kCapacity>& best) noexcept {
  if (best.full()) {
    if (best.back().odds >= found.odds) return;
    best.pop_back();
  }
  best.push_back({pose, found.hits, found.odds, foursome});
  for (std::size_t i = best.size() - 1; i > 0 && best[i - 1].odds < best[i].odds; --i)
    std::swap(best[i - 1], best[i]);
}

/// Nothing new would come of it: the labelling has all its pairs, and a pose like it (a card has two).
bool contains(const TargetLabelling& labelling, const Survivor& survivor) noexcept {
  const double turned = labelling.pose.rig_from_body.rotation.angularDistance(survivor.pose.rotation);
  return turned < kSamePose &&
         std::all_of(survivor.hits.begin(), survivor.hits.end(), [&](const TargetPair& hit) {
           return std::any_of(labelling.pairs.begin(), labelling.pairs.end(), [&](const TargetPair& pair) {
             return pair.dot == hit.dot && pair.target == hit.target;
           });
         });
}

/// It explains all targets turned to the cameras, and as well as noise does.
bool flawless(const TargetLabelling& labelling) noexcept {
  const double freedom = 2.0 * static_cast<double>(labelling.pairs.size()) - 6;
  return labelling.part >= 1 && labelling.pose.chi2 <= freedom + kImprobable / 2 * std::sqrt(2 * freedom);
}

/// A labelling that explains the same dots otherwise would come from here: three of them at least.
bool shares_dots(const DotFoursome& foursome, const TargetLabelling& labelling) noexcept {
  return std::count_if(labelling.pairs.begin(), labelling.pairs.end(), [&](const TargetPair& pair) {
           return std::find(foursome.dots.begin(), foursome.dots.end(), pair.dot) != foursome.dots.end();
         }) >= 3;
}

}  // namespace

struct TargetIdentifier::Work {
  Work(const TargetBody& given, const TargetIdentifierOptions& with)
      : body(given),
        options(with),
        patches(given, with.tilt_factor),
        verification(given, with.gate, with.least_part) {
    const double part = with.least_part * static_cast<double>(given.targets.size());
    // Of a body with faces a few may be all there is to see.
    const bool has_faces = std::any_of(given.targets.begin(), given.targets.end(),
                                       [](const Target& target) { return !target.normal.isZero(0); });
    least_nearby = has_faces ? 4 : std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(part)), 4, 5);
  }

  void search(std::span<const RigDot> given, TargetIdentification& result) noexcept;
  /// Stops where foursomes or hypotheses, of all searches together, have reached their number.
  void search(Kind kind, std::uint32_t most_foursomes, std::uint32_t most_hypotheses,
              TargetIdentification& result) noexcept;
  /// @param block  of triples of targets, where to go on (a solid body's)
  void collect_survivors(Kind kind, const DotFoursome& foursome, std::size_t& block,
                         TargetIdentification& result) noexcept;
  /// Completes the poses and keeps the two likeliest labellings seen so far.
  void judge(std::span<const Survivor> poses, TargetIdentification& result) noexcept;
  /// So good a match is no chance.
  bool credible(const TargetLabelling& labelling) const noexcept;
  /// Nothing found later could outdo it.
  bool beyond_doubt() const noexcept {
    return has_best && best.log_chance <= (flawless(best) ? kBeyondDoubt : kBeyondDoubtOfPart);
  }
  void answer(TargetIdentification& result) noexcept;

  TargetBody body;
  TargetIdentifierOptions options;
  TargetPatches patches;
  TargetVerification verification;
  DotPatches foursomes;
  std::span<const RigDot> dots;
  std::size_t least_nearby = 4;
  std::array<PatchLabels, kMostCandidates> candidates;
  StaticVector<Survivor, kMostSurvivors> survivors;
  StaticVector<Survivor, kMostDoubtful> doubtful;  ///< of all foursomes, for when nothing better comes
  TargetLabelling best, second, candidate;
  bool has_best = false, has_second = false;
};

TargetIdentifier::TargetIdentifier(const TargetBody& body, const TargetIdentifierOptions& options)
    : work_(std::make_unique<Work>(body, options)) {}
TargetIdentifier::~TargetIdentifier() = default;
TargetIdentifier::TargetIdentifier(TargetIdentifier&&) noexcept = default;
TargetIdentifier& TargetIdentifier::operator=(TargetIdentifier&&) noexcept = default;

TargetIdentification TargetIdentifier::identify(std::span<const RigDot> dots) noexcept {
  TargetIdentification result;
  Work& work = *work_;
  if (work.body.targets.size() < 4) {
    result.status = TargetIdentificationStatus::kTooFewTargets;
  } else if (!work.foursomes.start(dots, work.options.gate)) {
    result.status = TargetIdentificationStatus::kTooFewDots;
  } else {
    work.search(dots, result);
  }
  return result;
}

void TargetIdentifier::Work::search(std::span<const RigDot> given, TargetIdentification& result) noexcept {
  dots = given;
  verification.start(given);
  has_best = has_second = false;
  result.status = TargetIdentificationStatus::kNoMatch;
  // Four neighbours of one face are recognised at little cost; whatever mixes faces, only without them.
  const bool faces_first = !patches.flat() && patches.has_planar();
  if (faces_first || patches.flat()) {
    const auto part = faces_first ? kPartForFaces : 1.0;
    search(Kind::kPlanar, static_cast<std::uint32_t>(part * options.most_foursomes),
           static_cast<std::uint32_t>(part * options.most_hypotheses), result);
  }
  if (!patches.flat() && !has_best) {
    foursomes.rewind();
    search(Kind::kSolid, options.most_foursomes, options.most_hypotheses, result);
  }
  if (has_best) answer(result);
}

void TargetIdentifier::Work::search(Kind kind, std::uint32_t most_foursomes, std::uint32_t most_hypotheses,
                                    TargetIdentification& result) noexcept {
  DotFoursome foursome;
  std::uint32_t second_looks = 0, looks_elsewhere = 0;
  std::size_t comparisons = 0;
  doubtful.clear();
  while (!beyond_doubt() && foursomes.next(foursome, kind == Kind::kSolid)) {
    if (result.foursomes == most_foursomes || result.hypotheses >= most_hypotheses ||
        comparisons >= options.most_comparisons) {
      result.status = TargetIdentificationStatus::kWorkLimit;
      break;
    }
    if (has_best && second_looks >= (best.log_chance <= kBeyondDoubt ? kFewLooks : kSecondLooks)) break;
    if (has_best && !shares_dots(foursome, best) && ++looks_elsewhere > kLooksElsewhere) continue;
    ++result.foursomes;
    second_looks += has_best ? 1 : 0;
    std::size_t block = 0;
    comparisons += kind == Kind::kSolid ? patches.solid_triples() : 0;
    survivors.clear();
    do {
      collect_survivors(kind, foursome, block, result);
    } while (kind == Kind::kSolid && block < patches.blocks());
    judge(survivors, result);
    // Where the best leaves something to wish for, one of its foursome's less likely poses may be better.
    for (std::size_t i = 0; has_best && !flawless(best) && i < doubtful.size(); ++i)
      if (doubtful[i].foursome == result.foursomes) judge({&doubtful[i], 1}, result);
  }
  if (!has_best) judge(doubtful, result);
}

void TargetIdentifier::Work::collect_survivors(Kind kind, const DotFoursome& foursome, std::size_t& block,
                                               TargetIdentification& result) noexcept {
  const std::size_t count =
      kind == Kind::kPlanar
          ? patches.matching_planar(foursome.patch, candidates)
          : patches.matching_solid(foursome.patch, block, std::span(candidates).first(kSolidCandidates));
  if (count == 0) return;
  verification.look_at(foursome, foursomes.around(foursome.seed));
  ThreePoints three;
  for (std::size_t i = 0; i < 3; ++i) {
    three.origin[i] = dots[foursome.dots[i]].origin;
    three.ray[i] = dots[foursome.dots[i]].ray;
  }
  const RigDot& fourth = dots[foursome.dots[3]];
  const double reach = options.gate * foursome.spread;
  for (std::size_t c = 0; c < count; ++c) {
    const PatchLabels& labels = candidates[c];
    for (std::size_t i = 0; i < 3; ++i) three.point[i] = body.targets[labels[i]].position;
    ++result.hypotheses;
    std::array<Pose, kMostThreePointPoses> poses;
    const int found = central_three_point(three, poses);
    for (int p = 0; p < found; ++p) {
      const Pose& pose = poses[static_cast<std::size_t>(p)];
      const Eigen::Vector3d seen = (pose * body.targets[labels[3]].position - fourth.origin).normalized();
      if (!((fourth.whitener * seen).squaredNorm() < reach * reach)) continue;
      const PatchEvidence::Found& nearby = verification.explained_nearby(pose);
      if (nearby.hits.size() < least_nearby || nearby.odds < kLeastOdds) continue;
      if (nearby.odds >= kGoodOdds)
        keep(pose, nearby, result.foursomes, survivors);
      else
        keep(pose, nearby, result.foursomes, doubtful);
    }
  }
}

void TargetIdentifier::Work::judge(std::span<const Survivor> poses, TargetIdentification& result) noexcept {
  for (const Survivor& survivor : poses) {
    if (has_best && contains(best, survivor)) continue;
    ++result.verified;
    if (!verification.complete(survivor.pose, survivor.hits, candidate) || !credible(candidate)) continue;
    if (has_best && same_labelling(candidate, best)) {
      if (log_odds(candidate, best) > 0) best = candidate;
    } else if (!has_best || log_odds(candidate, best) > 0) {
      if (has_best) second = best;
      has_second = has_best;
      best = candidate;
      has_best = true;
    } else if (!has_second || log_odds(candidate, second) > 0) {
      second = candidate;
      has_second = true;
    }
  }
}

bool TargetIdentifier::Work::credible(const TargetLabelling& labelling) const noexcept {
  const double freedom = 2.0 * static_cast<double>(labelling.pairs.size()) - 6;
  const bool fits = labelling.pose.chi2 <= freedom + kImprobable * std::sqrt(2 * freedom);
  const bool few = labelling.part < kUsualPart || (labelling.pairs.size() == 4 && labelling.part < 1);
  const double share = few ? kShareOfFew : 0.0;
  return labelling.log_chance <= std::min(options.largest_log_chance + share, fits ? 0.0 : kBeyondDoubt);
}

void TargetIdentifier::Work::answer(TargetIdentification& result) noexcept {
  verification.try_other_minimum(best, candidate);
  if (credible(candidate) && log_odds(candidate, best) > 0) best = candidate;
  bool ambiguous = has_second && log_odds(best, second) < kLabellingMargin;
  ambiguous |= !verification.tell_close_dots_apart(best) || !credible(best);
  result.status =
      ambiguous ? TargetIdentificationStatus::kAmbiguous : TargetIdentificationStatus::kIdentified;
  result.pose = best.pose;
  result.pairs = best.pairs;
  result.log_chance = best.log_chance;
}

}  // namespace omma
