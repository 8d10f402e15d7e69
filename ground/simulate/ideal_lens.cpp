// `omma ideal-lens`: writes the lens file of an ideal equidistant fisheye of a given size and focal length.
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>

#include "fsw/kernel/input_error.hpp"
#include "ground/simulate/simulate.hpp"
#include "sim/equidistant_lens_file.hpp"

namespace omma::ground {
namespace {

struct IdealLensOptions {
  std::vector<int> size;
  double focal = 0;
  double field_deg = 180;
  std::vector<double> centre;
  std::string out;
};

int write_ideal_lens(const IdealLensOptions& options) {
  sim::EquidistantLens lens;
  lens.width = options.size[0];
  lens.height = options.size[1];
  lens.focal = options.focal;
  lens.field = options.field_deg * std::numbers::pi / 180.0;
  lens.centre = {0.5 * (lens.width - 1), 0.5 * (lens.height - 1)};
  if (!options.centre.empty()) lens.centre = {options.centre[0], options.centre[1]};
  const sim::OcamText file = sim::equidistant_as_ocam(lens);
  std::ofstream out(options.out, std::ios::binary | std::ios::trunc);
  out << file.text;
  out.close();
  if (!out) throw InputError(options.out, 0, "--out", "a file that can be written", "an error while writing");
  std::printf("%s: fitted to %.6f px inside %.1f degrees\n", options.out.c_str(), file.worst_px,
              options.field_deg);
  return 0;
}

}  // namespace

void add_ideal_lens(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<IdealLensOptions>();
  CLI::App* command =
      app.add_subcommand("ideal-lens", "Write the lens file (OCamCalib) of an ideal equidistant fisheye");
  command->add_option("--size", options->size, "Width and height [px]")
      ->required()
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(2, 16384));
  command->add_option("--focal", options->focal, "Focal length [px/rad]: f over the pixel's side")
      ->required()
      ->check(CLI::Range(1.0, 1e6));
  command->add_option("--field", options->field_deg, "Full field of view [degrees]")
      ->check(CLI::Range(1.0, 300.0));
  command->add_option("--centre", options->centre, "Optical axis [px], u and v; the middle where not given")
      ->expected(2)
      ->delimiter(',');
  command->add_option("--out", options->out, "File")->required();
  command->callback([options, &context] { context.exit_code = write_ideal_lens(*options); });
}

}  // namespace omma::ground
