#include "components/surveillance/surveillance.hpp"

#include <algorithm>

#include "components/tracker/sky_coverage.hpp"

namespace omma {

Surveillance::Surveillance(const SurveillanceParameters& parameters, const Rig& rig,
                           const StarCatalogue& catalogue, double floor_px)
    : parameters_(parameters),
      rig_(rig),
      catalogue_(catalogue),
      floor_px_(floor_px),
      tracks_(parameters, rig, sky_coverage(rig).solid_angle) {}

void Surveillance::visit_ports(PortVisitor& visitor) const {
  visitor.input("dots", dots);
  visitor.input("pairings", pairings);
  visitor.input("attitude", attitude);
  visitor.output("objects", objects);
  visitor.output("leftovers", leftovers);
}

void Surveillance::step(const Tick& /*tick*/) noexcept {
  UnknownObjects& out = *objects;
  if (out.time_ns > 0 && dots->time_ns > out.time_ns)
    tracks_.predict(1e-9 * static_cast<double>(dots->time_ns - out.time_ns));
  out.frame = dots->frame;
  out.time_ns = dots->time_ns;
  out.valid = attitude->valid;
  *leftovers = {};
  if (attitude->valid) {
    SkyFrame frame;
    frame.time_ns = dots->time_ns;
    frame.rig_from_j2000 = attitude->solution.rig_from_j2000;
    frame.attitude_covariance = attitude->solution.covariance;
    for (std::size_t c = 0; c < dots->cameras.size(); ++c) {
      frame.looking[c] = dots->cameras[c].status == FrameStatus::kFresh;
      frame.everywhere = frame.everywhere && dots->cameras[c].everywhere;
    }
    *leftovers =
        leftover_dots_.find(*dots, *pairings, *attitude, rig_, catalogue_, floor_px_, parameters_.gate_chi2);
    tracks_.take(*leftovers, frame);
  }
  out.leftover_dots = static_cast<std::uint32_t>(leftovers->size());
  tell();
}

void Surveillance::tell() noexcept {
  UnknownObjects& out = *objects;
  out.candidates = tracks_.candidates();
  out.not_followed = tracks_.not_followed();
  out.objects.clear();
  for (const ObjectTrack& track : tracks_.tracks()) {
    if (!track.active || track.number == 0) continue;
    UnknownObject object;
    object.number = track.number;
    object.motion = track.motion();
    object.first_seen_ns = track.first_seen_ns;
    object.last_seen_ns = track.last_seen_ns;
    object.sightings = track.sightings;
    object.missed = track.missed;
    object.direction = track.state.direction();
    object.covariance = track.state.covariance();
    object.velocity = track.state.velocity();
    object.velocity_covariance = track.state.velocity_covariance();
    object.score = track.score;
    object.bearing = track.bearing;
    out.objects.push_back(object);
  }
  std::sort(out.objects.begin(), out.objects.end(),
            [](const UnknownObject& a, const UnknownObject& b) { return a.number < b.number; });
}

}  // namespace omma
