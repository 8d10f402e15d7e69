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
constexpr std::size_t kMostSurvivors = 8;      // carried to all dots
/// Two labellings whose log-odds differ by less may either be right (1 in 10⁴).
constexpr double kLabellingMargin = 9.2;
constexpr double kBeyondDoubt = -12.0;  // log-chance at which the search stops
// Foursomes looked at after the first credible labelling short of that: those that share dots with it, and
// others.
constexpr std::uint32_t kSecondLooks = 60, kLooksElsewhere = 8;
// Of the bound on chance matches: labellings that explain less than the usual part of the targets turned to
// the cameras, or four of more, get a thousandth of it (ln), for chance makes many of them and the body few.
constexpr double kUsualPart = 0.7, kShareOfFew = -6.9;
constexpr double kImprobable = 6.0;  // χ² this many of its standard deviations too large is not noise

/// Foursomes of targets that a foursome of dots is compared with.
enum class Kind : std::uint8_t { kPlanar, kSolid };
constexpr double kPartForFaces = 0.75;  // of all work, for foursomes of one face

struct Survivor {
  Pose pose;
  std::size_t explained = 0;
};

/// The best few, most explained first; the earlier stays before the later.
void keep(const Survivor& survivor, StaticVector<Survivor, kMostSurvivors>& best) noexcept {
  if (best.full()) {
    if (best.back().explained >= survivor.explained) return;
    best.pop_back();
  }
  best.push_back(survivor);
  for (std::size_t i = best.size() - 1; i > 0 && best[i - 1].explained < best[i].explained; --i)
    std::swap(best[i - 1], best[i]);
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
  void collect_survivors(Kind kind, const DotFoursome& foursome, TargetIdentification& result) noexcept;
  /// Completes the survivors and keeps the two likeliest labellings seen so far.
  void judge(TargetIdentification& result) noexcept;
  /// So good a match is no chance.
  bool credible(const TargetLabelling& labelling) const noexcept;
  /// Nothing found later could outdo it.
  bool beyond_doubt() const noexcept { return has_best && best.log_chance <= kBeyondDoubt; }
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
  while (!beyond_doubt() && foursomes.next(foursome)) {
    if (result.foursomes == most_foursomes || result.hypotheses >= most_hypotheses) {
      result.status = TargetIdentificationStatus::kWorkLimit;
      break;
    }
    if (has_best && second_looks == kSecondLooks) break;
    if (has_best && !shares_dots(foursome, best) && ++looks_elsewhere > kLooksElsewhere) continue;
    ++result.foursomes;
    second_looks += has_best ? 1 : 0;
    collect_survivors(kind, foursome, result);
    judge(result);
  }
}

void TargetIdentifier::Work::collect_survivors(Kind kind, const DotFoursome& foursome,
                                               TargetIdentification& result) noexcept {
  survivors.clear();
  const std::size_t count = kind == Kind::kPlanar ? patches.matching_planar(foursome.patch, candidates)
                                                  : patches.matching_solid(foursome.patch, candidates);
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
      const std::size_t explained = verification.explained_nearby(pose);
      if (explained >= least_nearby) keep({pose, explained}, survivors);
    }
  }
}

void TargetIdentifier::Work::judge(TargetIdentification& result) noexcept {
  for (const Survivor& survivor : survivors) {
    ++result.verified;
    if (!verification.complete(survivor.pose, candidate) || !credible(candidate)) continue;
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
  const bool ambiguous = has_second && log_odds(best, second) < kLabellingMargin;
  result.status =
      ambiguous ? TargetIdentificationStatus::kAmbiguous : TargetIdentificationStatus::kIdentified;
  result.pose = best.pose;
  result.pairs = best.pairs;
  result.log_chance = best.log_chance;
}

}  // namespace omma
