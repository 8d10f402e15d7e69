#include "ground/stars/stars.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"
#include "ground/stars/sky_picture.hpp"
#include "ground/stars/star_counts.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPictureMagnitude = 3.5;  // Miller's figure 43
constexpr int kPictureWidth = 1400;

struct StarsArguments {
  std::vector<double> fields_deg{10, 20, 40, 60, 80, 100, 122, 150, 187};
  std::vector<double> magnitudes{1, 2, 3, 4, 5, 6};
  double merge_arcmin = 0;
  std::string output;
  bool json = false;
};

std::string text_of(const std::vector<StarCount>& counts) {
  std::string text =
      "field [deg]  V limit  uniform    mean   deviation  Poisson   5 %  median  95 %  least  most\n";
  for (const StarCount& c : counts) {
    text += format("%11.1f %8.2f %8.2f %7.2f %11.2f %8.2f %5d %7d %5d %6d %5d\n", c.field / kDegree,
                   c.magnitude, c.uniform, c.mean, c.deviation, std::sqrt(c.uniform), c.low, c.median, c.high,
                   c.least, c.most);
  }
  return text;
}

std::string json_of(const std::vector<StarCount>& counts) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const StarCount& c : counts) {
    json.push_back({{"field_deg", c.field / kDegree},
                    {"magnitude", c.magnitude},
                    {"uniform", c.uniform},
                    {"mean", c.mean},
                    {"deviation", c.deviation},
                    {"p05", c.low},
                    {"median", c.median},
                    {"p95", c.high},
                    {"least", c.least},
                    {"most", c.most}});
  }
  return json.dump(2) + "\n";
}

std::string count_chart_of(std::span<const SkyStar> stars, double field_deg) {
  std::vector<double> magnitudes;
  for (int quarter = 0; quarter <= 26; ++quarter) magnitudes.push_back(0.25 * quarter);
  const std::vector<double> fields{field_deg * kDegree};
  XySeries mean{"uniform", "a", Mark::kDashed, {}};
  XySeries low{"5 %", "a", Mark::kLine, {}};
  XySeries high{"95 %", "a", Mark::kLine, {}};
  XySeries least{"least", "b", Mark::kLine, {}};
  for (const StarCount& c : star_counts(stars, fields, magnitudes, 1500)) {
    mean.points.emplace_back(c.magnitude, c.uniform);
    low.points.emplace_back(c.magnitude, c.low);
    high.points.emplace_back(c.magnitude, c.high);
    least.points.emplace_back(c.magnitude, c.least);
  }
  XyChart chart;
  chart.title = format("Stars in a field of %g&deg;", field_deg);
  chart.x = {"V limit", false, 0, 6.5};
  chart.y = {"stars", true, 1, 5000};
  chart.series = {high, mean, low, least};
  return xy_chart(chart);
}

// Field of view that shows a number of stars: everywhere, and on the mean.
std::string field_chart(std::span<const SkyStar> stars) {
  XyChart chart;
  chart.title = "Field of view for a number of stars";
  chart.x = {"V limit", false, 1, 6.5};
  chart.y = {"full field of view [&deg;]", true, 3, 360};
  for (const auto& [count, colour] : {std::pair{4, "a"}, std::pair{8, "b"}, std::pair{30, "c"}}) {
    XySeries always{format("%d, always", count), colour, Mark::kLine, {}};
    XySeries mean{format("%d, mean", count), colour, Mark::kDashed, {}};
    for (int quarter = 4; quarter <= 26; ++quarter) {
      const double v = 0.25 * quarter;
      const FieldForStars field = field_for_stars(stars, v, count, 1500);
      if (field.always < 2 * std::numbers::pi) always.points.emplace_back(v, field.always / kDegree);
      if (field.mean < 2 * std::numbers::pi) mean.points.emplace_back(v, field.mean / kDegree);
    }
    chart.series.push_back(always);
    chart.series.push_back(mean);
  }
  return xy_chart(chart);
}

std::string page_of(std::span<const SkyStar> stars, const StarsArguments& arguments,
                    const std::vector<StarCount>& counts, const std::vector<std::uint8_t>& sky) {
  std::string html = page_head("Omma: stars", "Stars against field of view and magnitude",
                               "How many stars a circular field shows, over all directions of its axis.");
  html += "<div class='charts'>";
  for (const double field : arguments.fields_deg) html += count_chart_of(stars, field);
  html += field_chart(stars) + "</div><h2>The sky</h2>";
  html += picture(
      sky, format("Stars brighter than V %.1f, equal-area, J2000, right ascension growing to the left.",
                  kPictureMagnitude));
  std::vector<std::vector<std::string>> rows;
  rows.reserve(counts.size());
  for (const StarCount& c : counts) {
    rows.push_back({format("%g&deg;", c.field / kDegree), format("%.2f", c.magnitude),
                    format("%.1f", c.uniform), format("%.1f", c.deviation),
                    format("%.1f", std::sqrt(c.uniform)), format("%d", c.low), format("%d", c.median),
                    format("%d", c.high), format("%d", c.least), format("%d", c.most)});
  }
  html += "<h2>Numbers</h2>" + table({"field", "V limit", "uniform", "deviation", "Poisson's", "5 %",
                                      "median", "95 %", "least", "most"},
                                     rows);
  html +=
      "<p class='note'>Uniform: the number of stars brighter than the limit times the field's share of the "
      "sphere. It is the exact mean over all directions, however the stars are spread; what it cannot tell "
      "is "
      "the spread. The true deviation is larger than Poisson's where stars crowd to the Milky Way, and "
      "smaller "
      "where the field is a large part of the sky.</p>";
  return html + page_end();
}

int stars(const StarsArguments& arguments) {
  for (const double field : arguments.fields_deg) {
    if (!(field > 0 && field <= 360))
      throw InputError("arguments", 0, "--fov", "fields of view above 0 and up to 360 degrees",
                       format("%g", field));
  }
  const StarCatalogue catalogue({}, {20.0F, arguments.merge_arcmin / 60 * kDegree});
  std::vector<double> fields;
  for (const double field : arguments.fields_deg) fields.push_back(field * kDegree);
  const std::vector<StarCount> counts = star_counts(catalogue.stars(), fields, arguments.magnitudes);
  std::fputs((arguments.json ? json_of(counts) : text_of(counts)).c_str(), stdout);
  if (arguments.output.empty()) return 0;
  make_folder(arguments.output, "--output");
  const std::filesystem::path folder = arguments.output;
  const std::vector<std::uint8_t> sky =
      sky_picture(catalogue.stars(), kPictureMagnitude, kPictureWidth).png();
  write_bytes((folder / "sky.png").string(), sky);
  write_text_file((folder / "stars.json").string(), json_of(counts));
  write_page((folder / "stars.html").string(), page_of(catalogue.stars(), arguments, counts, sky));
  std::fprintf(stderr, "page written: %s\n", (folder / "stars.html").c_str());
  return 0;
}

}  // namespace

void add_stars(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<StarsArguments>();
  CLI::App* command =
      app.add_subcommand("stars", "Number of stars against field of view and magnitude, true and estimated");
  command->add_option("--fov", arguments->fields_deg, "Full fields of view [degrees]")->delimiter(',');
  command->add_option("--magnitude", arguments->magnitudes, "V limits")
      ->delimiter(',')
      ->check(CLI::Range(-2.0, 8.0));
  command->add_option("--merge", arguments->merge_arcmin, "Stars nearer than this are one [arcmin]")
      ->check(CLI::Range(0.0, 120.0));
  command->add_option("--output", arguments->output,
                      "Folder for stars.html, stars.json and the map of the sky");
  command->add_flag("--json", arguments->json, "One JSON array instead of text");
  command->callback([arguments, &context] { context.exit_code = stars(*arguments); });
}

}  // namespace omma::ground
