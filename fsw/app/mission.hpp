// Mission: everything the flight program is told at start-up, read from one TOML file (and the files it
// names).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "components/approach/approach_parameters.hpp"
#include "components/attitude/attitude.hpp"
#include "components/catalogue/target.hpp"
#include "components/exposure/exposure_control.hpp"
#include "components/extractor/camera_dots.hpp"
#include "components/geometry/rig.hpp"
#include "components/imaging/imaging_parameters.hpp"
#include "components/pose/relative_pose.hpp"
#include "components/surveillance/surveillance_parameters.hpp"
#include "components/telemetry/frame_stages.hpp"
#include "components/tracker/lookout.hpp"
#include "components/tracker/tracker_parameters.hpp"
#include "fsw/app/motion_mission.hpp"
#include "fsw/app/trigger_mission.hpp"
#include "hal/camera_setup.hpp"

namespace omma {

/// Where one camera's frames come from and how its dots are found.
struct CameraMission {
  std::string driver;  ///< "recorded", or one of live_drivers()
  int bits = 8;        ///< of a pixel of a recorded camera: the white level is 2^bits − 1
  CameraSetup setup;   ///< of a live camera
  ExtractorCamera dots;
  double read_noise_e = 5;  ///< of a pixel [electrons]; for weights where exposures are fused
  ExposureParameters exposure;
};

struct Mission {
  std::string file;
  Name spacecraft;
  double frame_rate_hz = 10;
  std::string epoch_utc;  ///< of frame 0; empty: stars at their J2000 places
  Rig rig;
  std::vector<CameraMission> cameras;  ///< in the order of the rig
  double frame_delay_ms =
      0;  ///< from a live frame's stamp to the trigger that collects it; 0: found from the first
  std::filesystem::path recording;  ///< folder of recorded frames, may be empty
  TriggerMission trigger;
  std::optional<MotionMission> motion;  ///< where a gimbal moves
  std::vector<TargetBody> bodies;
  LookoutParameters lookout;
  TrackerParameters tracker;
  AttitudeParameters attitude;
  RelativePoseParameters pose;
  /// Latest time after the trigger by which each stage is to be done [ms]; 0: as the schedule's budgets have
  /// it.
  telemetry::PerStage<double> latency_ms{};
  SurveillanceParameters surveillance;
  ApproachParameters approach;
  ImagingParameters imaging;  ///< a panorama every ten frame sets, unless the mission says otherwise
  int dds_domain = 0;
};

/// Reads and checks a mission; InputError names file, line and field of the first thing that is wrong.
Mission read_mission(const std::filesystem::path& file);

}  // namespace omma
