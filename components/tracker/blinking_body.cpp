#include "components/tracker/blinking_body.hpp"

#include <algorithm>
#include <bit>

#include "components/estimation/pose_search.hpp"

namespace omma {
namespace {

constexpr std::size_t kFewestLights = 4;  // three have up to four poses

BlinkCodes codes_of(const TargetBody& body) {
  BlinkCodes codes;
  for (const Target& target : body.targets) {
    if (!target.code.blinks()) continue;
    codes.length = target.code.length;
    codes.words.push_back(target.code.bits);
  }
  return codes;
}

/// A whole cycle was seen, and it was dark now and then: a steady dot says nothing of the phase.
bool has_told(const BlinkHistory& history, int length) {
  return std::popcount(history.known) >= length && history.lit != history.known;
}

}  // namespace

bool blinks(const TargetBody& body) noexcept {
  const auto count = std::count_if(body.targets.begin(), body.targets.end(),
                                   [](const Target& target) { return target.code.blinks(); });
  return static_cast<std::size_t>(count) >= kFewestLights;
}

BlinkingBody::BlinkingBody(const TargetBody& body)
    : body_(body), decoder_(codes_of(body)), tracks_(limits::kCameras) {
  for (std::size_t t = 0; t < body.targets.size(); ++t)
    if (body.targets[t].code.blinks()) target_of_code_.push_back(static_cast<std::uint16_t>(t));
}

void BlinkingBody::watch(std::uint64_t frame, SeenDots& dots, const BodyPairings& body) noexcept {
  for (const Pairing& pair : body.pairs) dots.claimed(pair.camera)[pair.dot] = 0;
  for (std::size_t c = 0; c < dots.cameras(); ++c)
    if (dots.list(c).status == FrameStatus::kFresh) follow(frame, dots, c);
  for (const Pairing& pair : body.pairs) dots.claimed(pair.camera)[pair.dot] = 1;
}

bool BlinkingBody::look(std::uint64_t frame, SeenDots& dots, BodyPairings& out) noexcept {
  out.pairs.clear();
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    if (dots.list(c).status != FrameStatus::kFresh) continue;  // not seen is not dark
    follow(frame, dots, c);
    tell(dots, c, out);
  }
  if (out.pairs.size() < kFewestLights) return false;
  sights_.clear();
  for (const Pairing& pair : out.pairs) sights_.push_back(pair.sight);
  const PoseSolution pose = find_pose(sights_, SolveOptions{}, used_);
  const bool found = pose.status == SolveStatus::kSolved && pose.pairs >= kFewestLights;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.pairs.size() && found; ++i)
    if (used_[i] != 0) out.pairs[kept++] = out.pairs[i];
  out.pairs.resize(kept);
  out.rig_from_body = pose.rig_from_body;
  return found;
}

void BlinkingBody::follow(std::uint64_t frame, SeenDots& dots, std::size_t camera) noexcept {
  places_.clear();
  dot_of_place_.clear();
  const auto claimed = dots.claimed(camera);
  for (std::size_t d = 0; d < claimed.size(); ++d) {
    if (claimed[d] != 0 || dots.ray(camera, d) == nullptr) continue;
    places_.push_back(dots.list(camera).dots[d].pixel);
    dot_of_place_.push_back(static_cast<std::uint16_t>(d));
  }
  tracks_[camera].step(frame, places_);
}

void BlinkingBody::tell(const SeenDots& dots, std::size_t camera, BodyPairings& out) noexcept {
  const std::span<const BlinkTrack> tracks = tracks_[camera].tracks();
  histories_.clear();
  track_of_history_.clear();
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (!has_told(tracks[t].history, decoder_.codes().length)) continue;
    if (!histories_.push_back(tracks[t].history)) break;
    track_of_history_.push_back(static_cast<std::uint16_t>(t));
  }
  if (histories_.empty()) return;
  decoder_.decode(histories_, identities_);
  for (std::size_t h = 0; h < histories_.size(); ++h) {
    const BlinkTrack& track = tracks[track_of_history_[h]];
    if (identities_[h].code < 0 || track.dot < 0) continue;
    const std::uint16_t target = target_of_code_[static_cast<std::size_t>(identities_[h].code)];
    const std::uint16_t dot = dot_of_place_[static_cast<std::size_t>(track.dot)];
    Pairing pair;
    pair.sight = SeenDots::sight(*dots.ray(camera, dot), body_.targets[target].position);
    pair.camera = static_cast<std::uint8_t>(camera);
    pair.dot = dot;
    pair.entry = target;
    if (!out.pairs.push_back(pair)) return;
  }
}

}  // namespace omma
