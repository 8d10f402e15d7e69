// Photographs of the sky whose truth others established: real ones and rendered ones, each with its lens,
// read from the shared data folder (its README.md says where each comes from). Tests and benches share the
// list.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "components/catalogue/observer.hpp"
#include "components/geometry/rig.hpp"

namespace omma {

/// One or several images of one instant, and what is known of them.
struct Photograph {
  std::string name;
  std::vector<std::filesystem::path> images;  ///< one a camera
  std::vector<std::filesystem::path> lenses;  ///< one a camera; empty: a pinhole camera of `fov_deg`
  double fov_deg = 0;                         ///< horizontal
  Rig rig;                                    ///< the cameras, with those lenses
  Observer observer;                          ///< epoch and site where known
  std::string epoch;                          ///< the same as an operator types it; empty: not known
  std::string site;
  bool has_truth = true;                                     ///< false: no one is known to have solved it
  Eigen::Matrix3d rig_from_j2000 = Eigen::Matrix3d::Zero();  ///< truth, a rotation
  /// An answer farther than this from the truth about an axis is wrong ["]: what the truth is good for, and
  /// the lens where it is assumed.
  Eigen::Vector3d tolerance_arcsec = Eigen::Vector3d::Zero();
};

enum class PhotographGroup {
  kLongyearbyen,  ///< all-sky camera, real
  kIndi,          ///< trees, text, a meteor, real
  kMediumField,   ///< 6 to 20 degrees, real, pinhole assumed
  kRigs,          ///< four rigs of three cameras, rendered, jointly
  kRigImages,     ///< the same twelve images, each alone
  kSingles,       ///< rendered, five projections
  kClutter,       ///< rendered, with Moon, planets, ground lights
};
const char* name_of(PhotographGroup group);

/// @param data  the folder that holds `sky`
/// @return empty where the folder is not there
std::vector<Photograph> photographs(const std::filesystem::path& data, PhotographGroup group);

/// The rotation vector from the true to the solved attitude, rig axes ["].
Eigen::Vector3d error_arcsec(const Photograph& photograph, const Eigen::Quaterniond& rig_from_j2000);

}  // namespace omma
