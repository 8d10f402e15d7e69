#include "ground/resect/card_resector.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "components/estimation/least_squares.hpp"
#include "components/estimation/pose_search.hpp"
#include "components/extractor/dot_extractor.hpp"
#include "components/tracker/body_pairing.hpp"
#include "components/tracker/seen_dots.hpp"
#include "components/tracker/target_identification.hpp"

namespace omma::ground {
namespace {

constexpr int kPasses = 4;
constexpr int kUnknowns = 6;
// Tried from sharp to dull: a lens file that is better than the last of them is found by the first that
// works.
constexpr std::array kLensErrors{0.1, kLensErrorAtFirst, 1.0};

const char* reason(TargetIdentificationStatus status) {
  switch (status) {
    case TargetIdentificationStatus::kTooFewDots:
      return "too few dots";
    case TargetIdentificationStatus::kTooFewTargets:
      return "fewer than four targets in the database";
    case TargetIdentificationStatus::kAmbiguous:
      return "several labellings explain the dots equally well";
    case TargetIdentificationStatus::kWorkLimit:
      return "no labelling found within the limit on the search";
    default:
      return "no labelling of the dots explains enough of the targets";
  }
}

Eigen::Vector3d middle_of(const TargetBody& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Target& target : body.targets) sum += target.position;
  return sum / static_cast<double>(body.targets.size());
}

bool usable(const PoseSolution& pose) {
  return pose.status == SolveStatus::kSolved || pose.status == SolveStatus::kIterationCap;
}

}  // namespace

DotPolarity polarity_of(const TargetBody& body) {
  const auto bright = std::count_if(body.targets.begin(), body.targets.end(),
                                    [](const Target& target) { return target.type == 1; });
  if (bright == 0) return DotPolarity::kDark;
  return static_cast<std::size_t>(bright) == body.targets.size() ? DotPolarity::kBright : DotPolarity::kBoth;
}

struct CardResector::Work {
  Work(const Rig& the_rig, const TargetBody& the_body, const ExtractorParameters& parameters)
      : rig(the_rig), body(the_body), extractor(parameters), identifier(body) {
    for (const RigCamera& camera : rig.cameras)
      extractors.push_back(std::make_unique<DotExtractor>(camera.lens.width(), camera.lens.height()));
  }

  void extract(const std::vector<ImageView>& images);
  bool identify(Resection& resection);
  bool start_by_hand(const std::vector<ManualPair>& pairs, Resection& resection) const;
  bool pair_and_solve(double error, Resection& resection);
  void residuals(Resection& resection) const;
  void finish(Resection& resection) const;

  Rig rig;
  TargetBody body;
  ExtractorParameters extractor;
  TargetIdentifier identifier;
  std::vector<std::unique_ptr<DotExtractor>> extractors;
  DotLists dots;
  SeenDots seen;
  BodyPairing body_pairing;
};

void CardResector::Work::extract(const std::vector<ImageView>& images) {
  dots.cameras.resize(rig.cameras.size());
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    dots.cameras[c] = {};
    if (c >= images.size() || images[c].empty()) continue;
    extractors[c]->extract(images[c], extractor, dots.cameras[c]);
    dots.cameras[c].status = FrameStatus::kFresh;
  }
}

bool CardResector::Work::identify(Resection& resection) {
  TargetIdentification found;
  for (const double error : kLensErrors) {
    seen.build(dots, rig, error);
    found = identifier.identify(seen.rays());
    if (found.status == TargetIdentificationStatus::kIdentified) break;
  }
  resection.pose = found.pose;
  resection.log10_chance_match = found.log_chance / std::log(10.0);
  if (found.status == TargetIdentificationStatus::kIdentified) return true;
  resection.reason = reason(found.status);
  if (found.status == TargetIdentificationStatus::kTooFewDots)
    resection.reason += " (" + std::to_string(seen.rays().size()) + ")";
  return false;
}

// A pose from the pairs alone, a few of them wrong at most; what the dots then say replaces them.
bool CardResector::Work::start_by_hand(const std::vector<ManualPair>& pairs, Resection& resection) const {
  resection.by_hand = true;
  std::vector<Sight> sights;
  for (const ManualPair& pair : pairs) {
    Dot dot;
    dot.pixel = pair.pixel;
    dot.covariance = kHandSigmaPx * kHandSigmaPx * Eigen::Matrix2d::Identity();
    RigDot ray;
    if (rig_dot(dot, 0, rig.cameras[pair.camera], static_cast<std::uint8_t>(pair.camera), 0, ray))
      sights.push_back(SeenDots::sight(ray, body.targets[pair.target].position));
  }
  resection.pose = find_pose(sights, SolveOptions{}, {});
  if (usable(resection.pose)) return true;
  resection.reason = "the pairs picked by hand do not make one pose";
  return false;
}

// Every target the pose explains, and the least squares over them.
bool CardResector::Work::pair_and_solve(double error, Resection& resection) {
  seen.build(dots, rig, error);
  AssignmentGate gate;
  gate.floor_px = error;
  StaticVector<Pairing, limits::kTargetPairs> pairs;
  const PredictedPose prediction{resection.pose.rig_from_body, resection.pose.covariance};
  BodyPrediction wanted{&body, prediction, &pairs};
  body_pairing.pair(seen, rig, {&wanted, 1}, gate);
  std::vector<Sight> sights;
  for (const Pairing& pairing : pairs) sights.push_back(pairing.sight);
  std::vector<std::uint8_t> used(sights.size());
  resection.pose = solve_pose(sights, prediction.rig_from_body, SolveOptions{}, used);
  resection.pairs.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) resection.pairs.push_back({pairs[i], used[i] != 0, 0});
  return usable(resection.pose);
}

// Distance of each dot from its target [px].
void CardResector::Work::residuals(Resection& resection) const {
  for (SolvedPair& pair : resection.pairs) {
    const RigCamera& camera = rig.cameras[pair.pairing.camera];
    const Eigen::Vector3d point =
        camera.rig_from_camera.inverse() * (resection.pose.rig_from_body * pair.pairing.sight.point);
    Eigen::Vector2d pixel;
    if (!camera.lens.project(point.normalized(), pixel)) continue;
    pair.residual_px = (dots.cameras[pair.pairing.camera].dots[pair.pairing.dot].pixel - pixel).norm();
  }
  resection.residual_rms_px = residual_rms(resection.pairs);
}

void CardResector::Work::finish(Resection& resection) const {
  resection.targets_used.assign(rig.cameras.size(), 0);
  for (const SolvedPair& pair : resection.pairs)
    if (pair.used) ++resection.targets_used[pair.pairing.camera];
  // The middle of the targets moves by δt and, turned about the body's origin, by δθ × (R m).
  const Pose& pose = resection.pose.rig_from_body;
  const Eigen::Vector3d arm = pose.rotation * middle_of(body);
  const Eigen::Vector3d middle = pose.translation + arm;
  resection.range = middle.norm();
  const Eigen::Vector3d along = middle / resection.range;
  Vector6d gradient;
  gradient << arm.cross(along), along;
  resection.range_sigma = std::sqrt(gradient.dot(resection.pose.covariance * gradient));
}

CardResector::CardResector(const Rig& rig, const TargetBody& body, const ExtractorParameters& extractor)
    : work_(std::make_unique<Work>(rig, body, extractor)) {}
CardResector::~CardResector() = default;

const DotLists& CardResector::dots() const {
  return work_->dots;
}

Resection CardResector::resect(const std::vector<ImageView>& images, const std::vector<ManualPair>& by_hand) {
  Resection resection;
  work_->extract(images);
  const bool begun = by_hand.empty() ? work_->identify(resection) : work_->start_by_hand(by_hand, resection);
  if (!begun) return resection;
  // As for stars: solve, measure what the lens file is wrong by, solve again with what was measured.
  double error = kLensErrorAtFirst;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!work_->pair_and_solve(error, resection)) {
      resection.reason = resection.pose.status == SolveStatus::kUnobservable
                             ? "the targets seen do not fix all six degrees of freedom"
                             : "identified targets do not agree on one pose";
      return resection;
    }
    work_->residuals(resection);
    resection.lens_error_px = error;
    error = lens_error(resection.pairs, work_->dots, kUnknowns);
  }
  resection.solved = true;
  work_->finish(resection);
  return resection;
}

}  // namespace omma::ground
