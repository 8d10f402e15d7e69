// Lookout: where the next images are worth looking at. What was paired when the whole images were last
// searched, and the objects that are followed, get windows where they are expected now; the whole images are
// searched every so many frame sets, and whenever the sky or a body is lost.
#pragma once

#include <vector>

#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/extractor/search_windows.hpp"
#include "components/geometry/rig.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/surveillance/unknown_objects.hpp"
#include "components/tracker/constant_rate.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/tracker_parameters.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

struct LookoutParameters {
  int full_search_every = 1;  ///< frame sets; 1: always the whole images
};

class Lookout final : public Component {
 public:
  /// @param tracker  its accelerations are what the predictions allow for
  /// @param rig      outlives this
  Lookout(const LookoutParameters& parameters, const TrackerParameters& tracker, const Rig& rig,
          std::size_t bodies);

  In<Frames> frames;
  Previous<DotLists> dots;  // of the frame set before, as all below
  Previous<Pairings> pairings;
  Previous<AttitudeEstimate> attitude;
  Previous<PoseEstimates> poses;
  Previous<UnknownObjects> objects;
  Out<SearchWindows> windows;

  std::string_view name() const override { return "lookout"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  static constexpr std::uint8_t kSky = 0xFF;
  /// Something that was paired: a star or planet by its direction in J2000, a target by its place on a body.
  struct Expected {
    Eigen::Vector3d point;
    float reach;  // of its dot from its centre [px]
    std::uint8_t camera;
    std::uint8_t body;  // kSky: none
  };
  static constexpr std::size_t kExpected =
      limits::kStarPairs + limits::kSolarPairs + limits::kTargetPairs * limits::kTargetBodies;

  void learn() noexcept;
  void remember() noexcept;
  void expect(std::span<const Pairing> pairs, std::uint8_t body) noexcept;
  bool must_search() const noexcept;
  bool is_tracked() const noexcept;
  TimeNs time_now() const noexcept;
  void look_for_expected(TimeNs now) noexcept;
  void look_for_objects(TimeNs now) noexcept;
  void add(std::size_t camera, const PredictedPoint& point, double reach) noexcept;

  LookoutParameters parameters_;
  const Rig& rig_;
  AttitudePrediction sky_;
  std::vector<PosePrediction> bodies_;  // as many as the mission has, from the start
  StaticVector<Expected, kExpected> expected_;
  int since_full_ = 0;     // frame sets since the whole images were searched
  bool was_full_ = false;  // the frame set before
  int lost_for_ = 0;       // frame sets until the whole images need not be searched any more
};

}  // namespace omma
