// A flight at the level of dots: what the extractor would find in the frames of a turning rig, with its noise
// and its truth: stars by the demo's photon budget (trails smear the light and cost faint stars), planets, a
// card that passes before them, objects that cross, hot pixels, false dots; lights that touch become one dot.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "components/catalogue/solar_system.hpp"
#include "components/catalogue/star.hpp"
#include "components/catalogue/target.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"

namespace omma {

enum class Light : std::uint8_t { kFalse, kStar, kTarget, kSolar, kObject };

/// What a light is: star by HR number, target by index, solar body and object by number.
struct LightName {
  Light kind = Light::kFalse;
  std::uint16_t entry = 0;
  bool operator==(const LightName&) const = default;
};

struct FlownSkyOptions {
  double frame_rate = 10;            ///< [Hz]
  double exposure = 0.05;            ///< [s]
  Eigen::Vector3d rate = {0, 0, 0};  ///< of the rig, rig axes [rad/s]
  double nutation_rate = 0;          ///< the axis of the turn goes round a cone so fast [rad/s] ...
  double nutation_angle = 0;         ///< ... of this half angle [rad]
  bool card = false;
  int objects = 0;
  bool planets = false;
  int hot_pixels = 0;  ///< of each camera
  int false_dots = 0;  ///< of each camera and frame set, anywhere
  std::uint64_t seed = 1;
};

/// The demo's sensors: electrons a second of a V = 0 star, and of one pixel's sky; read noise; point spread.
struct PhotonBudget {
  double zero_point = 120000, sky = 150, read_noise = 5, psf_sigma = 0.7, least_snr = 5;
};

class FlownSky {
 public:
  /// @param stars, places, card  outlive this
  FlownSky(const Rig& rig, std::span<const SkyStar> stars, const SolarSystem& places, const TargetBody& card,
           const FlownSkyOptions& options);

  /// The dots of the next frame set, brightest first in each camera.
  void next(DotLists& lists);

  Eigen::Quaterniond rig_from_j2000() const { return attitude_; }
  Pose rig_from_card() const;
  /// Everything a dot is the light of; the brightest first.
  std::span<const LightName> names(std::size_t camera, std::size_t dot) const { return names_[camera][dot]; }
  std::size_t stars_seen() const { return stars_seen_; }

 private:
  struct Source {
    Eigen::Vector2d pixel;
    double electrons;
    double sigma_along, sigma_across;  // of the centre [px]
    Eigen::Vector2d along;
    LightName name;
    bool saturated = false;
    double extent = 0;  // radius of a disc [px]
  };
  struct Runner {
    Eigen::Vector3d start, axis;
    double rate, magnitude;
  };

  void turn(double seconds);
  double snr_of(double electrons) const;
  bool add(std::size_t camera, const Eigen::Vector3d& in_rig, double magnitude,
           const Eigen::Vector3d& turning, LightName name);
  void add_card(std::size_t camera);
  bool behind_card(std::size_t camera, const Eigen::Vector3d& in_rig) const;
  void gather(std::size_t camera, DotList& list);
  double gauss() { return gauss_(random_); }
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  const Rig& rig_;
  std::span<const SkyStar> stars_;
  const SolarSystem& places_;
  const TargetBody& card_;
  FlownSkyOptions options_;
  PhotonBudget budget_;
  std::mt19937_64 random_;
  std::normal_distribution<double> gauss_;
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond(0.5, -0.1, 0.7, 0.4).normalized();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  double time_ = 0;
  std::uint64_t frame_ = 0;
  std::vector<Runner> runners_;
  std::array<std::vector<Eigen::Vector2d>, limits::kCameras> hot_pixels_;
  std::vector<Source> sources_;
  std::array<std::vector<std::vector<LightName>>, limits::kCameras> names_;
  std::size_t stars_seen_ = 0;
};

}  // namespace omma
