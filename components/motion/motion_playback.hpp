// Motion of recorded frames: tells what the axes did when the frames were recorded, and commands nothing.
#pragma once

#include "components/motion/recorded_motion.hpp"
#include "components/sync_trigger/trigger.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

class MotionPlayback final : public Component {
 public:
  explicit MotionPlayback(RecordedMotion motion) : motion_(std::move(motion)) {}

  In<Trigger> trigger;
  Out<MotionReport> report;

  std::string_view name() const override { return "motion_playback"; }
  void visit_ports(PortVisitor& visitor) const override {
    visitor.input("trigger", trigger);
    visitor.output("report", report);
  }
  void step(const Tick& tick) noexcept override;

 private:
  RecordedMotion motion_;
  bool begun_ = false;
  TimeNs start_ns_ = 0;
};

}  // namespace omma
