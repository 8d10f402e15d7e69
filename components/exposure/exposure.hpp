// Exposure: looks at every fresh frame and asks the cameras for more or less light, one knob a camera; or for
// several exposures in turn.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "components/camera/frames.hpp"
#include "components/exposure/exposure_report.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/events.hpp"

namespace omma {

inline constexpr EventDescriptor kExposureAtLimit{
    .id = 80,
    .severity = EventSeverity::kWarning,
    .name = "exposure_at_limit",
    .text =
        "camera {0} cannot be turned further: its background is {1} of the range, {2} of its pixels are full",
    .values = {{{"camera"}, {"background"}, {"full"}}}};

inline constexpr EventDescriptor kExposureRefused{
    .id = 81,
    .severity = EventSeverity::kWarning,
    .name = "exposure_refused",
    .text =
        "camera {0} did not take an exposure of {1} at gain {2}: reason {3} (1 no control, 2 out of range, "
        "3 failed)",
    .values = {{{"camera"}, {"exposure", "us"}, {"gain"}, {"reason"}}}};

inline constexpr std::array kExposureEvents{kExposureAtLimit, kExposureRefused};
static_assert(are_unique(kExposureEvents) && are_well_formed(kExposureEvents));

class Exposure final : public Component {
 public:
  /// @param drivers     one a camera, in the order of the rig; they outlive this. Called by the thread that
  /// steps
  ///                    this, which is the one that grabs
  /// @param parameters  one a camera
  Exposure(std::span<CameraDriver* const> drivers, std::span<const ExposureParameters> parameters,
           Events& events);

  In<Frames> frames;
  Out<ExposureReport> report;

  std::string_view name() const override { return "exposure"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  // A camera that refuses so often in a row is left alone.
  static constexpr std::uint32_t kPatience = 5;

  struct Controlled {
    CameraDriver* driver;
    ExposureControl control;
    StaticVector<TimeNs, kMostBracketed> bracket_ns{};
    bool begun = false;
    bool at_limit = false;
    std::uint32_t refused_in_row = 0;
  };

  void control(std::size_t camera, const CameraSettings& taken, const Tick& tick) noexcept;
  void bracket(std::size_t camera, const Tick& tick) noexcept;
  void ask(std::size_t camera, const CameraSettings& settings, const Tick& tick) noexcept;

  std::vector<Controlled> cameras_;  // as many as drivers, from the start
  Events& events_;
};

}  // namespace omma
