// Keeps committed parameters in a folder, in two files by turns: whatever happens to the one that is being
// written, the other holds the set before. Saving is a chore of an ordinary thread (Chores); nobody real-time
// waits for a disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fsw/services/durable_file.hpp"
#include "fsw/services/parameters.hpp"

namespace omma {

class ParameterStore {
 public:
  /// @param folder  made where it is missing; @throws InputError where it cannot be
  /// @param files   null: the system's; else what a test puts in its place
  ParameterStore(std::filesystem::path folder, std::string spacecraft, Parameters& parameters,
                 DurableFile* files = nullptr);
  ParameterStore(const ParameterStore&) = delete;
  ParameterStore& operator=(const ParameterStore&) = delete;

  /// Before time starts: puts the newest good set in force.
  /// @return what was found, a sentence each: the values that are not the mission's, files that are not good
  std::vector<std::string> load();

  /// Saves what was committed since the last time, if anything. One ordinary thread: in real time a chore, in
  /// lockstep between two ticks.
  void save_pending();

  /// Why a set could not be saved, in a sentence; empty while all is well.
  const std::string& failure() const { return failure_; }

  std::filesystem::path slot(int index) const;

 private:
  std::filesystem::path folder_;
  std::string spacecraft_;
  Parameters& parameters_;
  DurableFile system_files_;
  DurableFile& files_;
  int next_slot_ = 0;
  std::string failure_;
};

}  // namespace omma
