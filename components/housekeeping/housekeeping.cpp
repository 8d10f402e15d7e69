#include "components/housekeeping/housekeeping.hpp"

#include <algorithm>
#include <cmath>

namespace omma {

void Housekeeping::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.input("dots", dots);
  visitor.input("pairings", pairings);
  visitor.input("attitude", attitude);
  visitor.input("poses", poses);
  visitor.input("health", health);
  visitor.output("channels", channels);
}

void Housekeeping::step(const Tick& tick) noexcept {
  ChannelValues out;
  out.tick = tick.number;
  out.time_ns = tick.time_ns;
  const auto fresh = std::count_if(frames->cameras.begin(), frames->cameras.end(),
                                   [](const Frame& frame) { return frame.status == FrameStatus::kFresh; });
  out[kFreshCameras] = static_cast<double>(fresh);
  out[kMissingCameras] = static_cast<double>(frames->cameras.size()) - static_cast<double>(fresh);
  out[kDotCount] = 0;
  out[kDotsDropped] = 0;
  for (const DotList& list : dots->cameras) {
    out[kDotCount] += static_cast<double>(list.dots.size());
    out[kDotsDropped] += list.dropped;
  }
  out[kStarsPaired] = static_cast<double>(pairings->sky.pairs.size());
  out[kBodiesTracked] = static_cast<double>(
      std::count_if(pairings->bodies.begin(), pairings->bodies.end(),
                    [](const BodyPairings& body) { return body.state != TrackState::kLost; }));
  out[kUnclaimedDots] = pairings->unclaimed_dots;
  out[kSolutions] = attitude->valid ? 1 : 0;
  for (const PoseEstimate& pose : poses->bodies) out[kSolutions] += pose.valid ? 1 : 0;
  if (attitude->valid) {
    out[kAttitudeResidual] = attitude->solution.residual_rms;
    out[kAttitudeSigma] = std::sqrt(attitude->solution.covariance.diagonal().maxCoeff());
  }
  if (attitude->rate_valid) out[kAttitudeRate] = attitude->rate.norm();
  if (health->valid) {
    out[kHealthState] = static_cast<double>(health->state);
    out[kMemoryViolations] = static_cast<double>(health->memory_violations);
    out[kTicksMissed] = static_cast<double>(health->ticks_missed);
  }
  *channels = out;
}

}  // namespace omma
