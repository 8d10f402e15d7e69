// The folder of a simulated recording: <dir>/<camera>/<camera>_<n>.png, truth.jsonl, scenario.json, and
// copies of the rig, lens and target files, so that the folder explains itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/image.hpp"
#include "sim/scenario.hpp"

namespace omma::ground {

class SimulationFolder {
 public:
  /// Makes the folder; the frames of an earlier simulation in it are removed.
  /// @throws InputError where it cannot be made, or holds something else than a simulation
  SimulationFolder(const std::filesystem::path& top, const sim::Scenario& scenario);

  /// Safe from several threads at once, for different images.
  void write_image(int camera, std::uint64_t frame, const ImageView& image) const;
  /// exposures.csv of each camera with a bracket.
  void write_exposures() const;
  /// All lines of truth.jsonl. It is written last: a folder that has it is complete.
  void write_truth(const std::vector<std::string>& lines) const;

 private:
  void clear() const;
  void copy_inputs() const;

  std::filesystem::path top_;
  const sim::Scenario& scenario_;
};

}  // namespace omma::ground
