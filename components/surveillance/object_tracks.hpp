// Object tracks: leftover dots of many frame sets → objects. Every dot that no track takes begins a track;
// each track keeps the odds that it is a thing rather than chance (Sittler's likelihood ratio); the odds
// confirm it or end it. Sources: S. Blackman, R. Popoli, Design and Analysis of Modern Tracking Systems,
// 1999, ch. 6.2 (track score: ln P_D / (2π √|S| β) − d²/2 for a dot, ln (1 − P_D) for none); A. Wald's bound:
// chance brings a score beyond T in at most one track of e^T.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "components/surveillance/leftover_dots.hpp"
#include "components/surveillance/object_state.hpp"
#include "components/surveillance/surveillance_parameters.hpp"
#include "components/surveillance/unknown_objects.hpp"

namespace omma {

/// Where an object stood, against the stars and against the rig.
struct ObjectPlace {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< J2000
  Eigen::Vector3d ray = Eigen::Vector3d::UnitX();        ///< rig
};

struct ObjectTrack {
  bool active = false;
  std::uint32_t number = 0;  ///< 0: not confirmed
  ObjectState state;
  double score = 0;
  TimeNs first_seen_ns = 0;
  TimeNs last_seen_ns = 0;
  std::uint32_t sightings = 0;
  std::uint32_t missed = 0;
  ObjectPlace from;                                ///< its motion is judged from here
  ObjectPlace next_from;                           ///< and from here when its sightings have doubled
  Eigen::Vector3d ray = Eigen::Vector3d::UnitX();  ///< newest, rig
  double largest_sigma = 0;                        ///< of its dots [rad]
  ObjectBearing bearing;                           ///< in the newest frame set

  ObjectMotion motion() const noexcept;
};

/// The sky in one frame set, as far as tracks need it.
struct SkyFrame {
  TimeNs time_ns = 0;
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d attitude_covariance = Eigen::Matrix3d::Zero();  ///< small rotation, rig frame [rad²]
  std::array<bool, limits::kCameras> looking{};                   ///< cameras with a fresh frame
  bool everywhere = true;  ///< false: dots were looked for in windows about expected ones only
};

/// All storage inside; nothing is allocated.
class ObjectTracks {
 public:
  /// @param solid_angle  of each camera [sr]
  ObjectTracks(const SurveillanceParameters& parameters, const Rig& rig, std::span<const double> solid_angle);

  /// All objects to the time of a new frame set.
  void predict(double seconds) noexcept;
  /// The leftover dots of that frame set: given to tracks one to one, new tracks begun, tracks confirmed and
  /// ended.
  void take(std::span<const LeftoverDot> dots, const SkyFrame& frame) noexcept;

  std::span<const ObjectTrack> tracks() const noexcept { return tracks_; }
  std::uint32_t candidates() const noexcept { return candidates_; }
  std::uint32_t not_followed() const noexcept { return not_followed_; }
  /// Score at which a track is confirmed.
  double threshold() const noexcept;

 private:
  struct Fit {
    std::uint16_t track;
    std::uint16_t dot;
    float cost;  // −2 ln of the likelihood, but for a constant
    float distance2;
    bool confirmed;
  };
  static constexpr std::size_t kFits = 4096;

  void find_fits(std::span<const LeftoverDot> dots, const Eigen::Matrix3d& common) noexcept;
  bool is_ambiguous(const Fit& fit, std::span<const LeftoverDot> dots) const noexcept;
  void assign(std::span<const LeftoverDot> dots, const SkyFrame& frame,
              const Eigen::Matrix3d& common) noexcept;
  void see(ObjectTrack& track, const LeftoverDot& dot, const SkyFrame& frame,
           const Eigen::Matrix3d& common) noexcept;
  void miss(ObjectTrack& track, const SkyFrame& frame) noexcept;
  bool should_be_seen(const ObjectTrack& track, const SkyFrame& frame) const noexcept;
  void begin_tracks(std::span<const LeftoverDot> dots, const SkyFrame& frame) noexcept;
  ObjectTrack* free_track() noexcept;
  void confirm() noexcept;
  void learn_density(std::span<const LeftoverDot> dots) noexcept;

  SurveillanceParameters parameters_;
  const Rig& rig_;
  std::array<double, limits::kCameras> solid_angle_{};
  std::array<double, limits::kCameras> density_{};  // of dots by chance, in one frame set [1/sr]
  double births_ = 10;                              // a frame set, running mean; wary at first
  double interval_s_ = 0.1;
  std::array<ObjectTrack, limits::kObjectTracks> tracks_{};
  std::size_t in_use_ = 0;  // slots from here on are free
  StaticVector<Fit, kFits> fits_;
  std::array<std::uint8_t, LeftoverDots::kDots> spent_{};  // of each leftover dot: 1 taken, 2 refused
  std::uint32_t confirmed_ = 0;                            // since start
  std::uint32_t candidates_ = 0;
  std::uint32_t not_followed_ = 0;
};

}  // namespace omma
