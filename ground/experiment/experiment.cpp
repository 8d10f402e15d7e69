#include "ground/experiment/experiment.hpp"

namespace omma::ground {

void add_experiment(CLI::App& app, CommandContext& context) {
  CLI::App* command =
      app.add_subcommand("experiment", "The dissertation's experiments: rendered, flown, beside the truth");
  command->require_subcommand(1);
  add_earth_rotation(*command, context);
  add_docking(*command, context);
  add_dynamic_range(*command, context);
  add_repetition(*command, context);
}

}  // namespace omma::ground
