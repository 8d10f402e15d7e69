#include "ground/card/card.hpp"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "components/catalogue/target_file.hpp"
#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/card/card_check.hpp"
#include "ground/card/card_reading.hpp"
#include "ground/card/card_sheet.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct DrawArguments {
  std::string targets;
  std::string out;
  std::string page;
  CardSheet sheet;
};

void set_page(const std::string& page, CardSheet& sheet) {
  if (page.empty()) return;
  static const std::map<std::string, std::pair<double, double>> kPages{
      {"a4", {210, 297}},           {"a3", {297, 420}},           {"letter", {215.9, 279.4}},
      {"a4-landscape", {297, 210}}, {"a3-landscape", {420, 297}}, {"letter-landscape", {279.4, 215.9}}};
  const auto found = kPages.find(page);
  if (found == kPages.end())
    throw InputError("arguments", 0, "--page", "a4, a3 or letter, with or without -landscape", page);
  sheet.page_width_mm = found->second.first;
  sheet.page_height_mm = found->second.second;
}

int draw(DrawArguments arguments) {
  const TargetBody body = read_target_file(arguments.targets);
  set_page(arguments.page, arguments.sheet);
  write_card_sheet(arguments.out, body, std::filesystem::path(arguments.targets).stem().string(),
                   arguments.sheet);
  std::printf("%s: %zu targets\n", arguments.out.c_str(), body.targets.size());
  return 0;
}

struct ReadArguments {
  std::string image;
  double width_mm = 0;
  double dots_per_inch = 0;
  std::string out;
};

int read(const ReadArguments& arguments) {
  if ((arguments.width_mm > 0) == (arguments.dots_per_inch > 0)) {
    throw InputError("arguments", 0, "size", "one of --width and --dpi",
                     arguments.width_mm > 0 ? "both" : "none");
  }
  const Image image = read_image(arguments.image);
  const double scale =
      arguments.width_mm > 0 ? arguments.width_mm / image.width : 25.4 / arguments.dots_per_inch;
  const CardReading reading = read_card(image.view(), scale, arguments.image);
  const std::string text = target_file_text(reading.body);
  if (arguments.out.empty()) {
    std::fputs(text.c_str(), stdout);
  } else {
    write_text_file(arguments.out, text);
  }
  std::fprintf(stderr, "%zu discs of %.2f mm, %d other marks passed over\n", reading.body.targets.size(),
               reading.disc_mm, reading.passed_over);
  return 0;
}

struct CheckArguments {
  std::string targets;
  std::string lens;
  double fov_deg = 120;
  int pixels = 768;
  std::vector<double> ranges{0.5, 1, 2, 4};
  double tolerance_mm = 3;
  double tilt_deg = 60;
  CheckOptions options;
  bool json = false;
};

Lens lens_of(const CheckArguments& arguments) {
  if (!arguments.lens.empty()) return read_lens_file(arguments.lens);
  const double half = 0.5 * arguments.fov_deg * kDegree;
  const double middle = 0.5 * (arguments.pixels - 1);
  return Lens::equidistant(arguments.pixels, arguments.pixels, 0.5 * arguments.pixels / half,
                           {middle, middle}, half);
}

std::string check_text(const TargetBody& body, const Likeness& likeness, const CheckArguments& arguments,
                       const std::vector<RangeCheck>& checks) {
  const bool whole = likeness.matched == body.targets.size();
  std::string text =
      likeness.matched == 0
          ? format("no turn lays three targets of the card on others within %.1f mm\n",
                   arguments.tolerance_mm)
          : format(
                "nearest likeness: turned by %.1f deg, %zu of %zu targets fall on targets within %.1f mm%s\n",
                likeness.angle / kDegree, likeness.matched, body.targets.size(), arguments.tolerance_mm,
                whole ? ": the card is symmetric, its pose can not be known" : "");
  text +=
      "range [m]  trials  right  wrong  ambiguous  none  two poses  position sigma [mm]  rotation sigma "
      "[deg]\n";
  for (const RangeCheck& c : checks) {
    text += format("%9.2f %7d %6d %6d %10d %5d %10d %20.3f %21.4f\n", c.range, c.trials, c.right, c.wrong,
                   c.ambiguous, c.trials - c.right - c.wrong - c.ambiguous, c.mirrored,
                   1e3 * c.position_sigma, c.rotation_sigma / kDegree);
  }
  return text;
}

std::string check_json(const TargetBody& body, const Likeness& likeness,
                       const std::vector<RangeCheck>& checks) {
  nlohmann::ordered_json json;
  json["targets"] = body.targets.size();
  json["nearest_likeness"] = {{"angle_deg", likeness.angle / kDegree}, {"matched", likeness.matched}};
  json["ranges"] = nlohmann::ordered_json::array();
  for (const RangeCheck& c : checks) {
    json["ranges"].push_back({{"range_m", c.range},
                              {"trials", c.trials},
                              {"right", c.right},
                              {"wrong", c.wrong},
                              {"ambiguous", c.ambiguous},
                              {"two_poses", c.mirrored},
                              {"position_sigma_m", c.position_sigma},
                              {"rotation_sigma_deg", c.rotation_sigma / kDegree}});
  }
  return json.dump(2) + "\n";
}

// 1 where the card is symmetric or a labelling was wrong: it should not fly.
int check(CheckArguments arguments) {
  const TargetBody body = read_target_file(arguments.targets);
  if (body.targets.size() < 4)
    throw InputError(arguments.targets, 0, "targets", "at least four", std::to_string(body.targets.size()));
  arguments.options.largest_tilt = arguments.tilt_deg * kDegree;
  const Lens lens = lens_of(arguments);
  const Likeness likeness = nearest_likeness(body, 1e-3 * arguments.tolerance_mm);
  std::vector<RangeCheck> checks;
  bool wrong = likeness.matched == body.targets.size();
  for (const double range : arguments.ranges) {
    if (!(range > 0)) throw InputError("arguments", 0, "--range", "metres above zero", format("%g", range));
    checks.push_back(check_at(body, lens, range, arguments.options));
    wrong = wrong || checks.back().wrong > 0;
  }
  std::fputs(
      (arguments.json ? check_json(body, likeness, checks) : check_text(body, likeness, arguments, checks))
          .c_str(),
      stdout);
  return wrong ? 1 : 0;
}

void add_draw(CLI::App& card, CommandContext& context) {
  auto arguments = std::make_shared<DrawArguments>();
  CLI::App* command = card.add_subcommand("draw", "A sheet to print at its true size");
  command->add_option("targets", arguments->targets, "Target database")->required();
  command->add_option("--out", arguments->out, "File: .svg, .pdf or .png")->required();
  command->add_option("--disc", arguments->sheet.disc_mm, "Diameter of the discs [mm]")
      ->check(CLI::Range(0.5, 1000.0));
  command->add_option("--margin", arguments->sheet.margin_mm, "Plate beyond the outermost discs [mm]")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--page", arguments->page,
                      "a4, a3 or letter, -landscape; without it the sheet fits the card");
  command->add_option("--dpi", arguments->sheet.dots_per_inch, "Of a PNG")->check(CLI::Range(20.0, 2400.0));
  command->add_flag("--labels", arguments->sheet.labels, "Each target's name beside it");
  command->callback([arguments, &context] { context.exit_code = draw(*arguments); });
}

void add_read(CLI::App& card, CommandContext& context) {
  auto arguments = std::make_shared<ReadArguments>();
  CLI::App* command =
      card.add_subcommand("read", "A scanned or drawn card, seen from the front, as a target database");
  command->add_option("image", arguments->image, "Picture (PNG, JPEG, FITS)")->required();
  command->add_option("--width", arguments->width_mm, "Printed width of the whole picture [mm]")
      ->check(CLI::Range(1.0, 1e5));
  command->add_option("--dpi", arguments->dots_per_inch, "Or its dots per inch")->check(CLI::Range(1.0, 1e5));
  command->add_option("--out", arguments->out, "File; without it the database is printed");
  command->callback([arguments, &context] { context.exit_code = read(*arguments); });
}

void add_check(CLI::App& card, CommandContext& context) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      card.add_subcommand("check", "Symmetries of a card, and how often it is known, at ranges");
  command->add_option("targets", arguments->targets, "Target database")->required();
  command->add_option("--lens", arguments->lens, "Lens file; without it an equidistant one");
  command->add_option("--fov", arguments->fov_deg, "Its field of view [degrees]")
      ->check(CLI::Range(5.0, 300.0));
  command->add_option("--pixels", arguments->pixels, "Across its field")->check(CLI::Range(64, 8192));
  command->add_option("--range", arguments->ranges, "Ranges [m]")->delimiter(',');
  command->add_option("--tolerance", arguments->tolerance_mm, "Of the likeness [mm]")
      ->check(CLI::Range(0.01, 1e4));
  command
      ->add_option("--tilt", arguments->tilt_deg, "Largest tilt of the card from facing the camera [degrees]")
      ->check(CLI::Range(0.0, 85.0));
  command->add_option("--dot-sigma", arguments->options.dot_sigma, "Of a dot, each axis [px]")
      ->check(CLI::Range(1e-3, 10.0));
  command->add_option("--hidden", arguments->options.hidden, "Share of the targets hidden")
      ->check(CLI::Range(0.0, 0.9));
  command->add_option("--trials", arguments->options.trials, "At each range")
      ->check(CLI::Range(1, 1'000'000));
  command->add_flag("--json", arguments->json, "One JSON object instead of text");
  command->callback([arguments, &context] { context.exit_code = check(*arguments); });
}

}  // namespace

void add_card(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("card", "Target cards: draw, read from a picture, check");
  command->require_subcommand(1);
  add_draw(*command, context);
  add_read(*command, context);
  add_check(*command, context);
}

}  // namespace omma::ground
