#include "components/approach/light_candidates.hpp"

#include <algorithm>

#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr std::uint32_t kSurePath = 10;  // sightings: on a shorter path warm pixels pass for stars
constexpr TimeNs kForgotten = 10'000'000'000;
constexpr double kOfLate = 0.1;   // of a running mean, a frame set
constexpr double kNotFaint = 12;  // snr at which a light is seen in nearly every frame set
constexpr double kOften = 0.7;
constexpr double kBrighter = 1.5;  // times the faintest, to take its place

}  // namespace

bool LightCandidate::is_steady() const noexcept {
  return snr < kNotFaint || often >= kOften;
}

void LightCandidates::begin(TimeNs time_ns) noexcept {
  interval_ns_ = time_ns - time_ns_;
  time_ns_ = time_ns;
  for (LightCandidate& one : lights_) one.seen = false;
}

void LightCandidates::show(const UnknownObject& object, const CandidateLight& light, bool followed) noexcept {
  LightCandidate* place = nullptr;
  for (LightCandidate& one : lights_)
    if (one.number == object.number) place = &one;
  const bool of_the_sky =
      object.motion == ObjectMotion::kMoving || object.motion == ObjectMotion::kWithTheStars;
  if (!of_the_sky) {  // seen through
    if (place != nullptr) {
      *place = lights_.back();
      lights_.pop_back();
    }
    return;
  }
  if (place != nullptr) place->often += kOfLate * ((object.bearing.seen ? 1.0 : 0.0) - place->often);
  if (!object.bearing.seen || object.sightings < kSurePath) return;
  if (place == nullptr) place = place_for(object.bearing.flux);
  if (place == nullptr) return;
  if (place->number == 0) {
    place->number = object.number;
    place->since_ns = time_ns_;
    const double frame_sets = 1 + static_cast<double>(time_ns_ - object.first_seen_ns) /
                                      static_cast<double>(std::max<TimeNs>(interval_ns_, 1));
    place->often = std::min(1.0, object.sightings / frame_sets);
  }
  place->seen = true;
  place->followed = followed;
  place->seen_ns = time_ns_;
  place->flux = object.bearing.flux;
  place->snr = object.bearing.snr;
  place->direction = object.direction;
  if (light.sigma > 0)
    place->growth.see(1e-9 * static_cast<double>(time_ns_ - place->since_ns), light.log_brightness,
                      light.sigma);
}

// A free one, or that of the faintest that does not come nearer.
LightCandidate* LightCandidates::place_for(double flux) noexcept {
  const auto free = [](const LightCandidate& one) { return !one.followed; };
  if (static_cast<std::size_t>(std::count_if(lights_.begin(), lights_.end(), free)) < number_ &&
      lights_.size() < lights_.capacity()) {
    lights_.push_back({});
    return &lights_.back();
  }
  LightCandidate* faintest = nullptr;
  for (LightCandidate& one : lights_)
    if (free(one) && !one.growth.grows() && (faintest == nullptr || one.flux < faintest->flux))
      faintest = &one;
  if (faintest == nullptr || flux < kBrighter * faintest->flux) return nullptr;
  *faintest = {};
  return faintest;
}

void LightCandidates::end() noexcept {
  for (std::size_t i = lights_.size(); i-- > 0;) {
    if (time_ns_ - lights_[i].seen_ns <= kForgotten) continue;
    lights_[i] = lights_.back();
    lights_.pop_back();
  }
}

const LightCandidate* LightCandidates::find(std::uint32_t number) const noexcept {
  for (const LightCandidate& one : lights_)
    if (one.number == number) return &one;
  return nullptr;
}

bool LightCandidates::outgrows(const LightCandidate& one, const LightCandidate& other) noexcept {
  const double difference = one.growth.closing() - other.growth.closing();
  const double sigma = root_sum_square(one.growth.closing_sigma(), other.growth.closing_sigma());
  return one.growth.grows() && difference > LightGrowth::kSure * sigma;
}

bool LightCandidates::likelier(const LightCandidate& one, const LightCandidate& other) noexcept {
  if (one.growth.grows() != other.growth.grows()) return one.growth.grows();
  return one.flux > other.flux;
}

}  // namespace omma
