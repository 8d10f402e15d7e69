// Text, JSON and page of the dynamic-range experiment.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/draw/canvas.hpp"
#include "ground/experiment/dynamic_range.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Miller §13.5: dimmest star, with the lamp's rays on the lens, and blacklevels that still show a card.
constexpr double kDissertationDimmest = 4.25;
constexpr double kDissertationLamp = 2.35;
constexpr double kDissertationCard[8][2] = {{15, 108}, {29, 108}, {41, 108}, {53, 115},
                                            {68, 115}, {73, 115}, {78, 115}, {83, 120}};

// Places in SequenceResult::limits.
constexpr std::size_t kSingle = 3;
constexpr std::size_t kAveraged = 4;

double dissertation_of(const SequenceResult& s) {
  return s.lamp ? kDissertationLamp : kDissertationDimmest;
}

std::string magnitude(double v) {
  return std::isfinite(v) ? format("%.2f", v) : std::string("none");
}

// The faintest star over all sequences of a kind, of one way of looking.
double dimmest_of(const DynamicRangeResult& r, bool lamp, std::size_t way) {
  double dimmest = -std::numeric_limits<double>::infinity();
  for (const SequenceResult& s : r.sequences) {
    if (s.lamp == lamp && way < s.limits.size()) dimmest = std::max(dimmest, s.limits[way].dimmest);
  }
  return dimmest;
}

// The mean over all sequences of a kind of where found and missed stars part.
double half_of(const DynamicRangeResult& r, bool lamp, std::size_t way) {
  double sum = 0;
  int count = 0;
  for (const SequenceResult& s : r.sequences) {
    if (s.lamp != lamp || way >= s.limits.size()) continue;
    sum += s.limits[way].half;
    ++count;
  }
  return sum / std::max(1, count);
}

}  // namespace

std::vector<std::uint8_t> composite_png(const GreyImage& composite) {
  std::vector<float> sorted = composite.value;
  const auto at = [&](double q) {
    const auto k = sorted.begin() + static_cast<std::ptrdiff_t>(q * double(sorted.size() - 1));
    std::nth_element(sorted.begin(), k, sorted.end());
    return *k;
  };
  const float black = at(0.02);
  const float white = std::max(at(0.998), black + 1);
  GreyPicture picture{composite.width, composite.height, {}};
  picture.pixels.reserve(composite.value.size());
  for (const float level : composite.value)
    picture.pixels.push_back(static_cast<std::uint8_t>(
        255 * std::sqrt(std::clamp((level - black) / (white - black), 0.0F, 1.0F))));
  return Canvas(picture).png();
}

std::string dynamic_range_text(const DynamicRangeResult& r) {
  std::string text;
  for (const SequenceResult& s : r.sequences) {
    text +=
        r.recorded
            ? format("recorded sequence: %d stars to V 7 looked for\n", s.stars)
            : format("gain %.0fx, blacklevel %.0f%s: background %.0f, %.1f %% white, %d stars looked for\n",
                     s.gain, s.blacklevel, s.lamp ? ", lamp on the lens" : "", s.background,
                     100 * s.saturated, s.stars);
    for (const Limit& limit : s.limits)
      text += format("  %-44s dimmest V %5s, half V %5.2f, %3d found, %.1f %% of empty places hold a dot\n",
                     limit.name.c_str(), magnitude(limit.dimmest).c_str(), limit.half, limit.found,
                     100 * limit.chance);
    if (!r.recorded) text += format("  %-44s dimmest V %5.2f\n", "dissertation", dissertation_of(s));
  }
  for (const TransitPoint& p : r.transit)
    text += format(
        "lamp at %4.0f deg: a card is not white to blacklevel %.0f, its plate %.3g times the dark current, "
        "discs %.1f sigma a pixel\n",
        p.lamp_angle / kDegree, p.blacklevel, p.plate_over_dark, p.disc_contrast_sigma);
  return text;
}

std::string dynamic_range_json(const DynamicRangeResult& r) {
  nlohmann::ordered_json json{{"experiment", "dynamic-range"}, {"recorded", r.recorded}};
  json["sequences"] = nlohmann::ordered_json::array();
  for (const SequenceResult& s : r.sequences) {
    nlohmann::ordered_json one{{"name", s.name},
                               {"gain", s.gain},
                               {"blacklevel", s.blacklevel},
                               {"lamp", s.lamp},
                               {"background", s.background},
                               {"share_white", s.saturated},
                               {"stars_looked_for", s.stars}};
    for (const Limit& limit : s.limits)
      one["limits"].push_back(
          {{"way", limit.name},
           {"dimmest_v", std::isfinite(limit.dimmest) ? nlohmann::ordered_json(limit.dimmest) : nullptr},
           {"half_v", limit.half},
           {"found", limit.found},
           {"chance", limit.chance}});
    json["sequences"].push_back(one);
  }
  json["transit"] = nlohmann::ordered_json::array();
  for (const TransitPoint& p : r.transit)
    json["transit"].push_back({{"lamp_deg", p.lamp_angle / kDegree},
                               {"largest_blacklevel", p.blacklevel},
                               {"plate_over_dark", p.plate_over_dark},
                               {"disc_contrast_sigma", p.disc_contrast_sigma}});
  json["dissertation"] = {{"dimmest_v", kDissertationDimmest}, {"dimmest_v_lamp", kDissertationLamp}};
  return json.dump(2) + "\n";
}

std::string dynamic_range_page(const DynamicRangeResult& r) {
  std::string html = page_head("Omma: dynamic range", "Dynamic range",
                               r.recorded ? "The dimmest star in a recorded sequence."
                                          : "The dimmest star that a logarithmic camera shows, against its "
                                            "blacklevel, and with a lamp as bright as the Sun on its lens.");
  std::string figures;
  for (const bool lamp : {false, true}) {
    if (!std::isfinite(dimmest_of(r, lamp, kSingle))) continue;
    const std::string where = lamp ? ", lamp on the lens" : "";
    const std::string there =
        r.recorded ? ""
                   : format("; the dissertation has V %.2f", lamp ? kDissertationLamp : kDissertationDimmest);
    figures += figure("V " + magnitude(dimmest_of(r, lamp, kSingle)),
                      format("dimmest star in single frames%s%s", where.c_str(), there.c_str()));
    const double half = half_of(r, lamp, kAveraged);
    figures += figure("V " + magnitude(half),
                      "half of the stars this bright are found in the average of the frames" + where);
  }
  html += figures_row(figures) + "<h2>Every sequence</h2>";
  std::vector<std::vector<std::string>> rows;
  for (const SequenceResult& s : r.sequences) {
    for (const Limit& limit : s.limits)
      rows.push_back({s.name + ": " + limit.name, magnitude(limit.dimmest), format("%.2f", limit.half),
                      format("%d of %d", limit.found, s.stars), format("%.1f %%", 100 * limit.chance),
                      r.recorded ? "" : format("%.2f", dissertation_of(s))});
  }
  html += table({"sequence and way of looking", "dimmest V", "half V", "found", "by chance", "dissertation"},
                rows);
  if (!r.transit.empty()) {
    XySeries here{"here", "a", Mark::kLine, {}};
    XySeries there{"dissertation", "b", Mark::kPoints, {}};
    for (const TransitPoint& p : r.transit) here.points.emplace_back(p.lamp_angle / kDegree, p.blacklevel);
    for (const auto& p : kDissertationCard) there.points.emplace_back(p[0], p[1]);
    XySeries any{"persistent", "a", Mark::kPoints, {}};
    XySeries stacked{"half, averaged", "c", Mark::kPoints, {}};
    for (const SequenceResult& s : r.sequences) {
      if (s.lamp) continue;
      any.points.emplace_back(s.blacklevel, s.limits[kSingle].dimmest);
      stacked.points.emplace_back(s.blacklevel, s.limits[kAveraged].half);
    }
    html += "<h2>Blacklevel</h2><div class='charts'>" +
            xy_chart({"Dimmest star", {"blacklevel", false, 0, 0}, {"V", false, 0, 7}, {any, stacked}}) +
            xy_chart({"Largest blacklevel at which a card is not white",
                      {"lamp off axis [&deg;]", false, 0, 90},
                      {"blacklevel", false, 80, 160},
                      {here, there}}) +
            "</div>";
  }
  html += "<h2>Composites, less the black frame</h2>";
  for (const SequenceResult& s : r.sequences) {
    if (s.name != r.sequences.front().name && !s.lamp) continue;
    html += picture(composite_png(s.average), s.name + ": average of the frames.");
    html += picture(composite_png(s.darken), s.name + ": the darkest of each pixel.");
  }
  return html +
         "<p class='note'>Half V parts found from missed stars with the fewest exceptions. By chance: share "
         "of "
         "places a few pixels beside a star that hold a dot as well. Persistent: in three frames or more, at "
         "one place.</p>" +
         page_end();
}

}  // namespace omma::ground
