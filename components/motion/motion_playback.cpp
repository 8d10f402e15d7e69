#include "components/motion/motion_playback.hpp"

namespace omma {

void MotionPlayback::step(const Tick& tick) noexcept {
  if (!begun_) start_ns_ = tick.time_ns;
  begun_ = true;
  report->time_ns = tick.time_ns;
  motion_.tell(trigger->number, static_cast<double>(elapsed(start_ns_, tick.time_ns)) * 1e-9, *report);
}

}  // namespace omma
