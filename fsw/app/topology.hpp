// Topology: the one file where everything is wired. Every component, every connection, every rate.
#pragma once

#include <memory>
#include <vector>

#include "components/attitude/attitude.hpp"
#include "components/camera/cameras.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/extractor/extractor.hpp"
#include "components/pose/relative_pose.hpp"
#include "components/sync_trigger/sync_trigger.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/worker_pool.hpp"

namespace omma {

/// How the program runs, as opposed to what it flies.
struct RunOptions {
  bool lockstep = true;  ///< replay: time waits for the program
  int workers = 1;       ///< threads that share the extraction, the caller included
};

/// All components of the flight program, wired. Made once, before time starts; nothing in it moves afterwards.
class Topology {
 public:
  /// @throws InputError where a file the mission names is not usable
  Topology(const Mission& mission, const RunOptions& options);
  Topology(const Topology&) = delete;
  Topology& operator=(const Topology&) = delete;

  RateGroupTable table();

 private:
  const Mission mission_;
  WorkerPool pool_;
  StarCatalogue catalogue_;
  std::vector<std::unique_ptr<CameraDriver>> drivers_;

 public:
  // In the order of the data.
  SyncTrigger sync_trigger;
  Cameras cameras;
  Extractor extractor;
  Tracker tracker;
  Attitude attitude;
  RelativePose pose;

 private:
  void connect();
};

}  // namespace omma
