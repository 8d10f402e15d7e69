// All that telemetry must have, as one component writes it: a step fills in what its test looks at.
#pragma once

#include "components/telemetry/telemetry.hpp"

namespace omma {

class TelemetrySource : public Component {
 public:
  Out<Frames> frames;
  Out<DotLists> dots;
  Out<Pairings> pairings;
  Out<AttitudeEstimate> attitude;
  Out<PoseEstimates> poses;
  Out<UnknownObjects> objects;
  Out<ImageChunk> image;
  Out<HealthReport> health;
  Out<TimingReport> timing;
  Out<UtcReport> utc;

  void visit_ports(PortVisitor& visitor) const override {
    visitor.output("frames", frames);
    visitor.output("dots", dots);
    visitor.output("pairings", pairings);
    visitor.output("attitude", attitude);
    visitor.output("poses", poses);
    visitor.output("objects", objects);
    visitor.output("image", image);
    visitor.output("health", health);
    visitor.output("timing", timing);
    visitor.output("utc", utc);
  }

  void feed(Telemetry& telemetry) {
    telemetry.frames.bind(frames);
    telemetry.dots.bind(dots);
    telemetry.pairings.bind(pairings);
    telemetry.attitude.bind(attitude);
    telemetry.poses.bind(poses);
    telemetry.objects.bind(objects);
    telemetry.image.bind(image);
    telemetry.health.bind(health);
    telemetry.timing.bind(timing);
    telemetry.utc.bind(utc);
  }
};

}  // namespace omma
