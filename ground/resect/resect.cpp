#include "ground/resect/resect.hpp"

#include <cstdio>
#include <memory>

#include "components/catalogue/target_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/photographs/photographs.hpp"
#include "ground/resect/card_resector.hpp"
#include "ground/resect/resect_report.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  PhotographArguments photographs;
  std::string targets;
  std::string pairs;
  std::string polarity;
  double gain = 0;
  double black_level = 0;
  bool json = false;
  std::string annotate;
};

ExtractorParameters extractor_of(const Arguments& arguments, const TargetBody& body) {
  ExtractorParameters extractor;
  extractor.polarity = arguments.polarity == "bright" ? DotPolarity::kBright
                       : arguments.polarity == "dark" ? DotPolarity::kDark
                       : arguments.polarity == "both" ? DotPolarity::kBoth
                                                      : polarity_of(body);
  extractor.gain = static_cast<float>(arguments.gain);
  extractor.black_level = static_cast<float>(arguments.black_level);
  return extractor;
}

bool resect_set(const Arguments& arguments, const TargetBody& body, std::size_t set) {
  const Photographs photographs = read_photographs(arguments.photographs, set);
  const std::vector<ImageView> views = photographs.views();
  CardResector resector(photographs.rig, body, extractor_of(arguments, body));
  std::vector<ManualPair> by_hand;
  if (!arguments.pairs.empty()) by_hand = read_manual_pairs(arguments.pairs, photographs.rig, body);
  const Resection resection = resector.resect(views, by_hand);
  const std::string told = arguments.json ? resection_json(photographs.rig, resection, resector.dots())
                                          : resection_text(photographs.rig, resection, resector.dots());
  std::fputs(told.c_str(), stdout);
  for (std::size_t c = 0; c < views.size() && !arguments.annotate.empty(); ++c) {
    if (views[c].empty()) continue;
    write_annotated(annotated_name(arguments.photographs, photographs, arguments.annotate, set, c), views[c],
                    photographs.rig, c, body, resection, resector.dots());
  }
  return resection.solved;
}

int resect(const Arguments& arguments) {
  check(arguments.photographs);
  const TargetBody body = read_target_file(arguments.targets);
  if (!arguments.pairs.empty() && set_count(arguments.photographs) > 1)
    throw InputError("arguments", 0, "--pairs", "one image, or one image of each camera of a rig",
                     std::to_string(set_count(arguments.photographs)) + " images");
  bool all_solved = true;
  for (std::size_t set = 0; set < set_count(arguments.photographs); ++set)
    all_solved = resect_set(arguments, body, set) && all_solved;
  return all_solved ? 0 : 1;
}

}  // namespace

void add_resect(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "resect", "Pose of a camera or rig from one image of a target card, by its pattern alone");
  add_photograph_options(*command, arguments->photographs);
  command->add_option("--targets", arguments->targets, "target database: id x y z group type, tab-separated")
      ->required();
  command->add_option(
      "--pairs", arguments->pairs,
      "begin from pairs picked by hand, one a line: u v TARGET, with a rig CAMERA u v TARGET");
  command
      ->add_option("--polarity", arguments->polarity,
                   "side of the background the targets are on; default: by their types in the database")
      ->check(CLI::IsMember({"bright", "dark", "both"}));
  command->add_option("--gain", arguments->gain, "electrons per grey level; default: guessed")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--black-level", arguments->black_level, "grey level of no light")
      ->check(CLI::Range(0.0, 65535.0));
  command->add_flag("--json", arguments->json, "one JSON object an image or rig instead of text");
  command->add_option("--annotate", arguments->annotate,
                      "write the picture with circled dots and named targets");
  command->callback([arguments, &context] { context.exit_code = resect(*arguments); });
}

}  // namespace omma::ground
