// Cameras: takes the frame of each camera for the trigger of this frame set and says how each one does.
#pragma once

#include <array>
#include <span>

#include "components/camera/camera_events.hpp"
#include "components/camera/frames.hpp"
#include "components/sync_trigger/trigger.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/events.hpp"

namespace omma {

class Cameras final : public Component {
 public:
  /// @param drivers  one per camera, in the order of the rig; they outlive this component
  /// @param events   told what the cameras lost
  Cameras(std::span<CameraDriver* const> drivers, Events& events);

  In<Trigger> trigger;
  Out<Frames> frames;

  std::string_view name() const override { return "camera"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

  /// True when no camera will ever deliver again (every recording played to its end).
  bool at_end() const noexcept;

 private:
  FrameStatus judge(const Frame& frame, std::size_t camera) noexcept;

  static constexpr int kStuckAfter = 3;  // identical frame numbers in a row before a camera counts as stuck

  void tell(const Tick& tick, std::size_t camera) noexcept;

  Events& events_;
  StaticVector<CameraDriver*, limits::kCameras> drivers_;
  std::array<CameraHealth, limits::kCameras> told_{};
  std::array<std::uint64_t, limits::kCameras> last_number_{};
  std::array<int, limits::kCameras> repeats_{};
  TimeNs last_trigger_ns_ = 0;
  TimeNs since_last_trigger_ns_ = 0;  // 0 at the first
};

}  // namespace omma
