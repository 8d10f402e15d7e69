// The truth of a simulated recording, as truth.jsonl tells it: one frame set a line, with the true attitude,
// the true poses, and every spot of light with how well it could be placed. Fields:
// docs/algorithms/simulation.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "components/geometry/pose.hpp"

namespace omma::ground {

struct TruthSpot {
  enum class Kind : std::uint8_t { kStar, kTarget, kMoon, kSun, kPlanet };
  Kind kind = Kind::kStar;
  int camera = 0;        ///< index in the rig
  std::uint16_t hr = 0;  ///< star: number in the Bright Star Catalogue
  std::string body;      ///< target: its body
  std::string id;        ///< target: its name in the body's target file; planet: its name
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double snr = 0;                                         ///< flux over its smallest possible deviation
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< of the pixel position [px⁻²]
};

struct TruthBody {
  std::string name;
  Pose rig_from_body;
};

/// What one camera's image shows of an uneven motion: the mean of its exposure less the midpoint, rig axes.
struct TruthExposure {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< [rad]
  std::vector<Vector6d> bodies;                    ///< of the frame's bodies: turn [rad], move [m]
};

struct TruthFrame {
  std::uint64_t frame = 0;
  std::int64_t time_ns = 0;  ///< exposure midpoint, since frame 0
  std::string utc;
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  ///< of the rig, rig frame [rad/s]
  std::vector<TruthBody> bodies;
  std::vector<TruthSpot> spots;
  std::vector<TruthExposure> exposures;  ///< one a camera; empty where the truth does not tell
};

/// Frame sets in rising order. @param cameras  of the rig: a spot of another camera is an error
/// @throws InputError (file, line, field, expected, found): no such file, no frame set in it, a line that is
/// not a JSON object, a field that is missing, of another type or not a finite number, a frame number that
/// does not rise
std::vector<TruthFrame> read_truth(const std::filesystem::path& file, int cameras);

}  // namespace omma::ground
