// Approach: follows a body from a light among the stars to its fiducials. Its light is one of the unknown
// objects: the one the ground names, else the brightest that is none of the rig; that choice is looked at
// again every frame set until its range is known. It is followed by itself: its direction, its range from
// brightness, and both from the pose once fiducials are told apart; and back again when the body goes away.
#pragma once

#include <array>
#include <vector>

#include "components/approach/approach_estimate.hpp"
#include "components/approach/approach_parameters.hpp"
#include "components/approach/body_light.hpp"
#include "components/approach/light_candidates.hpp"
#include "components/approach/light_doubt.hpp"
#include "components/approach/photometric_zero.hpp"
#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/surveillance/object_state.hpp"
#include "components/surveillance/unknown_objects.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/command.hpp"

namespace omma {

inline constexpr CommandDescriptor kFollowObject{
    .id = 40,
    .name = "follow_object",
    .text = "an unknown object is a body's light; 0: the brightest there is",
    .arguments =
        {{{.name = "body", .type = ValueType::kInteger, .least = 0, .most = limits::kTargetBodies - 1},
          {.name = "object", .type = ValueType::kInteger, .least = 0, .most = 4294967295.0}}},
    .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr std::array kApproachCommands{kFollowObject};

class Approach final : public Component, public CommandReceiver {
 public:
  /// @param catalogue  as the surveillance's; outlives this, as do `rig` and `bodies`
  /// @param floor_px   lens calibration error, per axis, added to every dot [px]
  Approach(const ApproachParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
           std::span<const TargetBody> bodies, double floor_px);

  In<Frames> frames;
  In<DotLists> dots;
  In<Pairings> pairings;
  In<AttitudeEstimate> attitude;
  In<PoseEstimates> poses;
  In<UnknownObjects> objects;
  In<std::span<const LeftoverDot>> leftovers;
  Out<ApproachEstimates> estimates;

  std::string_view name() const override { return "approach"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  void skipped(const Tick& tick) noexcept override;
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;

 private:
  struct Followed {
    Followed(const FollowedBody& body, const BodySize& body_size, const RangeModeParameters& parameters)
        : told(body), size(body_size), range(body.range), modes(parameters) {}
    FollowedBody told;
    BodySize size;
    ObjectState bearing;
    RangeFilter range;
    RangeModes modes;
    bool followed = false;
    bool seen = false;
    double summed = 0;                               // ExpectedLight::summed
    Eigen::Matrix3d pull = Eigen::Matrix3d::Zero();  // of stars beside its dots, a running mean [rad²]
    double snr = 0;
    double flux = 0;  // of its brightest camera, when it was seen last [grey levels]
    LightDoubt doubt;
    int missed = 0;
    int unlike = 0;  // measurements of brightness in a row that do not fit what was known
    std::uint32_t object = 0;
    std::uint32_t commanded_object = 0;
  };

  void learn_zero() noexcept;
  void predict(double seconds) noexcept;
  const PoseEstimate* pose_of(const Followed& body) const noexcept;
  void look_at_candidates() noexcept;
  CandidateLight light_of(const UnknownObject& object) const noexcept;
  const LightCandidate* likeliest(const Followed& body) const noexcept;
  const UnknownObject* object_of(std::uint32_t number) const noexcept;
  void choose_light(Followed& body) noexcept;
  void follow(Followed& body, const UnknownObject& light) noexcept;
  void look_again(Followed& body) noexcept;
  bool is_free(std::uint32_t object) const noexcept;
  bool is_followed(std::uint32_t object) const noexcept;
  void see_pose(Followed& body, const PoseEstimate& pose) noexcept;
  void see_targets(Followed& body, const Eigen::Vector3d& position) noexcept;
  double sky_pull(const PoseEstimate& pose) const noexcept;
  ExpectedLight expected(const Followed& body) const noexcept;
  double off_axis(const Eigen::Vector3d& direction, std::size_t camera) const noexcept;
  void see_light(Followed& body) noexcept;
  Looked look(const ExpectedLight& expected, std::size_t camera, LightSighting& out) noexcept;
  void find_stars(const Eigen::Vector3d& direction, double reach_px, std::size_t camera) noexcept;
  Eigen::Matrix3d pull_of_stars(const Eigen::Vector3d& direction, double flux, std::size_t camera) noexcept;
  double sky_behind(const Followed& body, std::size_t camera, double background, double zero) const noexcept;
  void see_brightness(Followed& body, std::size_t camera, const LightSighting& sighting,
                      bool looked_for) noexcept;
  void lose(Followed& body) noexcept;
  void tell(const Followed& body, const PoseEstimate* pose, ApproachEstimate& out) const noexcept;

  ApproachParameters parameters_;
  const Rig& rig_;
  const StarCatalogue& catalogue_;
  std::span<const TargetBody> bodies_;
  double floor_px_;
  double finest_pixel_ = 1;  // of all cameras [rad]
  std::array<PhotometricZero, limits::kCameras> zeros_;
  std::array<float, StarCatalogue::kCapacity> magnitudes_{};  // by HR number
  std::vector<Followed> followed_;                            // filled once, at construction
  LightSightings sightings_;
  StaticVector<StarNearby, 32> stars_;
  LightCandidates candidates_;
  Eigen::Matrix3d rig_from_j2000_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d attitude_covariance_ = Eigen::Matrix3d::Zero();  // J2000
  TimeNs time_ns_ = 0;
};

}  // namespace omma
