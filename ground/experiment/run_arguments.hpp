// What every experiment of the whole chain is told: frames to render or frames recorded, the mission, and
// where its report goes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ground/experiment/chain.hpp"

namespace omma::ground {

struct RunArguments {
  std::string scenario;
  std::vector<std::string> recordings;
  std::string mission;
  std::string output;
  int frames = 0;
  bool keep_frames = false;
};

/// @param scenario  help of --scenario @param most  recordings that may be given
void add_run_options(CLI::App& command, RunArguments& arguments, const std::string& scenario, int most);

/// @throws InputError where neither or both of --scenario and --recording are given
void check_run_arguments(const RunArguments& arguments);

/// The scenario with the number of frame sets asked for. @throws InputError as read_scenario_file
sim::Scenario scenario_of(const RunArguments& arguments);

int processors();

}  // namespace omma::ground
