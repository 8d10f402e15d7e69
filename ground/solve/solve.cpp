#include "ground/solve/solve.hpp"

#include <cstdio>
#include <memory>

#include "fsw/kernel/input_error.hpp"
#include "ground/photographs/photographs.hpp"
#include "ground/solve/photograph_solver.hpp"
#include "ground/solve/solve_report.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  PhotographArguments photographs;
  std::string epoch;
  std::string site;
  std::string near;
  bool json = false;
  std::string annotate;
};

bool solve_set(const Arguments& arguments, const SolverOptions& options, std::size_t set) {
  const Photographs photographs = read_photographs(arguments.photographs, set);
  const std::vector<ImageView> views = photographs.views();
  PhotographSolver solver(photographs.rig, options);
  const PhotographSolution solution = solver.solve(views);
  const std::string told = arguments.json ? solution_json(photographs.rig, solution, solver.dots())
                                          : solution_text(photographs.rig, solution, solver.dots());
  std::fputs(told.c_str(), stdout);
  for (std::size_t c = 0; c < views.size() && !arguments.annotate.empty(); ++c) {
    if (views[c].empty()) continue;
    write_annotated(annotated_name(arguments.photographs, photographs, arguments.annotate, set, c), views[c],
                    photographs.rig, c, solution, solver.dots());
  }
  return solution.solved;
}

int solve(const Arguments& arguments) {
  check(arguments.photographs);
  if (!arguments.site.empty() && arguments.epoch.empty()) {
    throw InputError("arguments", 0, "--site",
                     "--epoch with it (refraction needs to know where the zenith is)", "no epoch");
  }
  SolverOptions options;
  if (!arguments.epoch.empty()) options.observer.julian_date_utc = parse_utc(arguments.epoch);
  if (!arguments.site.empty()) options.observer.site = parse_ground_site(arguments.site);
  if (!arguments.near.empty()) options.near = parse_sky_hint(arguments.near);
  bool all_solved = true;
  for (std::size_t set = 0; set < set_count(arguments.photographs); ++set)
    all_solved = solve_set(arguments, options, set) && all_solved;
  return all_solved ? 0 : 1;
}

}  // namespace

void add_solve(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("solve", "Attitude from photographs of the sky; no hint is needed");
  add_photograph_options(*command, arguments->photographs);
  command->add_option("--epoch", arguments->epoch,
                      "UTC of the exposure: proper motion and aberration are applied");
  command->add_option("--site", arguments->site, "LAT,LON,HEIGHT of the ground site: refraction is applied");
  command->add_option("--near", arguments->near,
                      "RA,DEC,RADIUS in degrees: the first camera looks near there; fewer stars suffice");
  command->add_flag("--json", arguments->json, "one JSON object instead of text");
  command->add_option("--annotate", arguments->annotate,
                      "write the picture with circled dots and named stars");
  command->callback([arguments, &context] { context.exit_code = solve(*arguments); });
}

}  // namespace omma::ground
