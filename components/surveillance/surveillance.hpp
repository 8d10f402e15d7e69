// Surveillance: what the tracker leaves unexplained is followed from frame set to frame set in J2000 axes,
// across the cameras, and told of once chance can hardly have made it.
#pragma once

#include <span>

#include "components/attitude/attitude_estimate.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "components/surveillance/leftover_dots.hpp"
#include "components/surveillance/object_tracks.hpp"
#include "components/surveillance/surveillance_parameters.hpp"
#include "components/surveillance/unknown_objects.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

class Surveillance final : public Component {
 public:
  /// @param catalogue  apparent places, with fainter stars than are paired; outlives this, as does `rig`
  /// @param floor_px   lens calibration error, per axis, added to every dot [px]
  Surveillance(const SurveillanceParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
               double floor_px);

  In<DotLists> dots;
  In<Pairings> pairings;
  In<AttitudeEstimate> attitude;
  Out<UnknownObjects> objects;
  Out<std::span<const LeftoverDot>> leftovers;  ///< of this frame set; none without an attitude

  std::string_view name() const override { return "surveillance"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  void tell() noexcept;

  SurveillanceParameters parameters_;
  const Rig& rig_;
  const StarCatalogue& catalogue_;
  double floor_px_;
  LeftoverDots leftover_dots_;  // what `leftovers` looks at
  ObjectTracks tracks_;
};

}  // namespace omma
