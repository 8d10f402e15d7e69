// What the docking experiments found: orientation, docking and imaging at once (one run), and the repetition
// of one run many times. Text, JSON and pages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ground/experiment/chain.hpp"
#include "ground/experiment/reference.hpp"
#include "ground/experiment/rig_pictures.hpp"

namespace omma::ground {

/// The figures of one run that are compared.
struct DockingTrial {
  AttitudeEvaluation attitude;
  PoseEvaluation pose;  ///< of the mission's first body
  PairCheck pairs;
  bool exposures_told = false;  ///< errors are told without the exposures' mean as well
  double duration = 0;          ///< [s]
  Reference reference;
  std::optional<PlatformMatch> platform;  ///< where the platform's motion stood in for the truth
};

/// @throws InputError where the mission has no body or its pose was never found
DockingTrial docking_trial(const ChainRun& run);

/// The card's rotation x y z [rad], its position x y z [m], and the rig's attitude x y z [rad].
using DockingAxes = Eigen::Matrix<double, 9, 1>;

/// Root mean square of each trial and how it spreads over trials, per axis.
struct TrialSpread {
  std::vector<DockingAxes> rms;  ///< of each trial
  DockingAxes mean = DockingAxes::Zero();
  DockingAxes deviation = DockingAxes::Zero();  ///< between trials
  DockingAxes bound = DockingAxes::Zero();      ///< rms of the bound over all trials
  DockingAxes expected_deviation =
      DockingAxes::Zero();  ///< that chance makes: rms / √(2 n), n frame sets a trial
};
TrialSpread trial_spread(const std::vector<DockingTrial>& trials);

std::string docking_text(const DockingTrial& trial);
std::string docking_json(const DockingTrial& trial);
/// @param panorama  PNG of the whole sky made on board; empty: none
std::string docking_page(const DockingTrial& trial, const std::vector<RigPicture>& pictures,
                         const std::vector<std::uint8_t>& panorama);

std::string repetition_text(const std::vector<DockingTrial>& trials);
std::string repetition_json(const std::vector<DockingTrial>& trials);
std::string repetition_page(const std::vector<DockingTrial>& trials);

}  // namespace omma::ground
