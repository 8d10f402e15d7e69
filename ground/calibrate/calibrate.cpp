#include "ground/calibrate/calibrate.hpp"

namespace omma::ground {

void add_calibrate(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("calibrate", "Lenses and rigs from images");
  command->require_subcommand(1);
  add_calibrate_axes(*command, context);
  add_calibrate_lens(*command, context);
  add_calibrate_rig(*command, context);
  add_calibrate_sky(*command, context);
}

}  // namespace omma::ground
