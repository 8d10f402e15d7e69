// The study of one rig on paper, all its parts together, and how it is told: text, JSON, one page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/target.hpp"
#include "ground/design/coverage.hpp"
#include "ground/design/expected_accuracy.hpp"

namespace omma::ground {

struct StudyOptions {
  double distance = 1.0;   ///< the sky is to be whole beyond it, from the rig's origin [m]
  double magnitude = 4.5;  ///< V of the faintest star that makes a dot
  double dot_sigma = 0.1;  ///< of a dot, each axis [px]
  double range = 1.0;      ///< of the target body from each camera [m]
};

struct DesignStudy {
  PaperRig paper;
  StudyOptions options;
  NeededField needed;           ///< by circular lenses at these places, beyond the distance
  NeededField needed_infinity;  ///< the same at infinity
  Coverage near;                ///< at the distance
  Coverage infinity;
  std::optional<double> whole_sky_beyond;  ///< [m]
  ExpectedSky sky;
  std::string body;  ///< empty: no targets given
  std::vector<std::optional<ExpectedPose>> poses;
  Eigen::Vector3d box = Eigen::Vector3d::Zero();  ///< that holds the camera centres [m]
};

/// @param body  null where no pose is asked for
DesignStudy study(const PaperRig& paper, const StudyOptions& options, const TargetBody* body);

/// One row of the table of symmetric rigs.
struct SymmetricRow {
  int cameras = 0;
  NeededField needed;
  NeededField needed_infinity;
};
std::vector<SymmetricRow> symmetric_table(double spacing, double distance);

std::string symmetric_text(const std::vector<SymmetricRow>& rows, double spacing, double distance);
std::string study_text(const DesignStudy& study);
std::string study_json(const std::vector<SymmetricRow>& rows, const DesignStudy* study);
/// @param study  null: the table alone; @param coverage_png  the picture of the study's coverage
std::string study_page(const std::vector<SymmetricRow>& rows, double spacing, double distance,
                       const DesignStudy* study, const std::vector<std::uint8_t>& coverage_png);

}  // namespace omma::ground
