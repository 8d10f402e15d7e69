// `omma`: everything on the ground, one command with subcommands.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "fsw/kernel/input_error.hpp"
#include "ground/blackframe/blackframe.hpp"
#include "ground/calibrate/calibrate.hpp"
#include "ground/cameras/cameras.hpp"
#include "ground/capture/capture.hpp"
#include "ground/card/card.hpp"
#include "ground/command.hpp"
#include "ground/compare/compare.hpp"
#include "ground/compare_motion/compare_motion.hpp"
#include "ground/composite/composite.hpp"
#include "ground/design/design.hpp"
#include "ground/design/predict.hpp"
#include "ground/dots/dots.hpp"
#include "ground/events/events.hpp"
#include "ground/experiment/experiment.hpp"
#include "ground/export/export.hpp"
#include "ground/feed/feed.hpp"
#include "ground/images/images.hpp"
#include "ground/mask/mask.hpp"
#include "ground/monitor/monitor.hpp"
#include "ground/motion/motion.hpp"
#include "ground/objects/objects.hpp"
#include "ground/record/record.hpp"
#include "ground/report/report.hpp"
#include "ground/resect/resect.hpp"
#include "ground/simulate/simulate.hpp"
#include "ground/solve/solve.hpp"
#include "ground/stars/stars.hpp"
#include "ground/uplink/uplink.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Omma ground tools: solve photographs, design, simulate, calibrate, monitor, record, report."};
  app.require_subcommand(1);
  omma::ground::CommandContext context;
  omma::ground::add_solve(app, context);
  omma::ground::add_resect(app, context);
  omma::ground::add_report(app, context);
  omma::ground::add_simulate(app, context);
  omma::ground::add_ideal_lens(app, context);
  omma::ground::add_monitor(app, context);
  omma::ground::add_record(app, context);
  omma::ground::add_command(app, context);
  omma::ground::add_events(app, context);
  omma::ground::add_export(app, context);
  omma::ground::add_compare(app, context);
  omma::ground::add_feed(app, context);
  omma::ground::add_composite(app, context);
  omma::ground::add_images(app, context);
  omma::ground::add_objects(app, context);
  omma::ground::add_compare_motion(app, context);
  omma::ground::add_calibrate(app, context);
  omma::ground::add_cameras(app, context);
  omma::ground::add_capture(app, context);
  omma::ground::add_card(app, context);
  omma::ground::add_design(app, context);
  omma::ground::add_predict(app, context);
  omma::ground::add_experiment(app, context);
  omma::ground::add_motion(app, context);
  omma::ground::add_servo_board(app, context);
  omma::ground::add_stars(app, context);
  omma::ground::add_dots(app, context);
  omma::ground::add_blackframe(app, context);
  omma::ground::add_mask(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const omma::InputError& error) {
    std::fprintf(stderr, "omma: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "omma: %s\n", error.what());
    return 2;
  }
  return context.exit_code;
}
