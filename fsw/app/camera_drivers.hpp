// The cameras of a mission, each behind the driver that its table names: the one place that knows all
// drivers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fsw/app/mission.hpp"
#include "fsw/app/run_options.hpp"
#include "hal/camera.hpp"

namespace omma {

/// True where time cannot wait for the program.
bool has_live_cameras(const Mission& mission);

class CameraDrivers {
 public:
  /// Opens every camera of the mission, none where `options.with_cameras` is false.
  /// @throws InputError where a recording or a device is not usable
  CameraDrivers(const Mission& mission, const RunOptions& options);

  /// In the order of the rig.
  std::vector<CameraDriver*> pointers() const;
  /// Frame sets until every recording has been played to its end; kEndless where a camera is live.
  std::uint64_t frame_sets() const;

 private:
  std::vector<std::unique_ptr<CameraDriver>> drivers_;
};

}  // namespace omma
