#include "ground/calibrate/drift_report.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kArcsec = std::numbers::pi / 180 / 3600;
constexpr double kHour = 3600;

// Three numbers that go together: a lens, or a camera's turn.
struct Group {
  std::string camera;
  bool turn = false;
  Eigen::Index at = 0;
};

std::vector<Group> groups_of(const SkyDrift& d) {
  std::vector<Group> groups;
  for (std::size_t c = 0; c < d.layout.cameras; ++c)
    groups.push_back({d.mean.rig.cameras[c].name.c_str(), false, DriftLayout::lens_at(c)});
  for (std::size_t c = 1; c < d.layout.cameras; ++c)
    groups.push_back({d.mean.rig.cameras[c].name.c_str(), true, d.layout.turn_at(c)});
  return groups;
}

const char* name_of(const Group& group, Eigen::Index k) {
  constexpr std::array<const char*, 3> kLens{"centre u", "centre v", "focal length"};
  constexpr std::array<const char*, 3> kTurn{"turn x", "turn y", "turn z"};
  return (group.turn ? kTurn : kLens)[static_cast<std::size_t>(k)];
}
const char* unit_name(const Group& group, Eigen::Index k) {
  return group.turn ? "arcsec" : (k < 2 ? "px" : "ppm");
}
double unit(const Group& group, Eigen::Index k) {
  return group.turn ? kArcsec : (k < 2 ? 1 : 1e-6);
}

bool seen(const SkyDrift& d, const Group& group) {
  return d.squared_in_sigmas_of(group.at) > kSeenDrift;
}

}  // namespace

std::string drift_text(const SkyDrift& d) {
  const double hours = (d.windows.back().time - d.windows.front().time) / kHour;
  std::string text =
      format("drift over %.3f h in %zu windows of %zu to %zu stars\n", hours, d.windows.size(),
             std::min_element(d.windows.begin(), d.windows.end(),
                              [](const auto& a, const auto& b) { return a.stars < b.stars; })
                 ->stars,
             std::max_element(d.windows.begin(), d.windows.end(), [](const auto& a, const auto& b) {
               return a.stars < b.stars;
             })->stars);
  for (const Group& g : groups_of(d)) {
    text += format("%-8s %-5s chi2 %8.2f of 3: %s\n", g.camera.c_str(), g.turn ? "turn" : "lens",
                   d.squared_in_sigmas_of(g.at), seen(d, g) ? "it drifts" : "no drift seen");
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double per_hour = kHour / unit(g, k);
      text += format("  %-13s %12.4f +- %.4f %s in an hour\n", name_of(g, k), d.rate[g.at + k] * per_hour,
                     d.rate_sigma(g.at + k) * per_hour, unit_name(g, k));
    }
  }
  if (d.degrees > 0)
    text += format("windows scatter about the lines with chi2 %.2f per degree of freedom%s\n", d.scatter,
                   d.scatter > 1 ? "; the deviations are scaled by its root" : "");
  return text;
}

std::string drift_json(const SkyDrift& d) {
  nlohmann::ordered_json json{{"scatter_chi2_per_degree", d.scatter},
                              {"degrees_of_freedom", d.degrees},
                              {"middle_s", d.middle},
                              {"groups", nlohmann::ordered_json::array()},
                              {"windows", nlohmann::ordered_json::array()}};
  const std::vector<Group> groups = groups_of(d);
  for (const Group& g : groups) {
    nlohmann::ordered_json one{{"camera", g.camera},
                               {"of", g.turn ? "turn" : "lens"},
                               {"chi2", d.squared_in_sigmas_of(g.at)},
                               {"drifts", seen(d, g)},
                               {"numbers", nlohmann::ordered_json::array()}};
    for (Eigen::Index k = 0; k < 3; ++k)
      one["numbers"].push_back({{"name", name_of(g, k)},
                                {"unit", unit_name(g, k)},
                                {"offset", d.offset[g.at + k] / unit(g, k)},
                                {"rate_per_hour", d.rate[g.at + k] * kHour / unit(g, k)},
                                {"rate_sigma_per_hour", d.rate_sigma(g.at + k) * kHour / unit(g, k)}});
    json["groups"].push_back(one);
  }
  for (const DriftWindow& w : d.windows) {
    std::vector<double> sigma;
    for (Eigen::Index k = 0; k < w.offset.size(); ++k) sigma.push_back(std::sqrt(w.covariance(k, k)));
    json["windows"].push_back({{"time_s", w.time},
                               {"frame_sets", w.sets},
                               {"stars", w.stars},
                               {"offset", std::vector<double>(w.offset.begin(), w.offset.end())},
                               {"sigma", sigma}});
  }
  // Of offset and rate, in pixels, parts, radians and per second, in the order of the windows' offsets.
  json["covariance"] = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < d.covariance.rows(); ++row)
    json["covariance"].push_back(
        std::vector<double>(d.covariance.row(row).begin(), d.covariance.row(row).end()));
  return json.dump(1) + "\n";
}

namespace {

std::string chart_of(const SkyDrift& d, const Group& g, Eigen::Index k) {
  XyChart chart{escaped(g.camera) + ": " + name_of(g, k),
                {"time [h]", false, 0, 0},
                {format("from the mean [%s]", unit_name(g, k)), false, 0, 0},
                {}};
  XySeries points{"", "a", Mark::kPoints, {}};
  for (const DriftWindow& w : d.windows) {
    const double value = w.offset[g.at + k] / unit(g, k);
    const double sigma = std::sqrt(w.covariance(g.at + k, g.at + k)) / unit(g, k);
    points.points.emplace_back(w.time / kHour, value);
    chart.series.push_back(
        {"", "a", Mark::kLine, {{w.time / kHour, value - sigma}, {w.time / kHour, value + sigma}}});
  }
  XySeries line{"", "b", Mark::kDashed, {}};
  for (const DriftWindow& w : {d.windows.front(), d.windows.back()})
    line.points.emplace_back(w.time / kHour,
                             (d.offset[g.at + k] + d.rate[g.at + k] * (w.time - d.middle)) / unit(g, k));
  chart.series.push_back(points);
  chart.series.push_back(line);
  return xy_chart(chart);
}

}  // namespace

std::string drift_page(const SkyDrift& d) {
  std::string figures;
  std::string charts;
  std::vector<std::vector<std::string>> rows;
  for (const Group& g : groups_of(d)) {
    figures += figure(seen(d, g) ? "drifts" : "at rest",
                      escaped(g.camera) + (g.turn ? ", turn on the rig" : ", lens") +
                          format(": &chi;&sup2; of the rates %.1f, of 3", d.squared_in_sigmas_of(g.at)));
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double per_hour = kHour / unit(g, k);
      rows.push_back({escaped(g.camera) + ", " + name_of(g, k),
                      format("%.4f %s/h", d.rate[g.at + k] * per_hour, unit_name(g, k)),
                      format("%.4f", d.rate_sigma(g.at + k) * per_hour)});
      charts += chart_of(d, g, k);
    }
  }
  return page_head(
             "Omma: drift of a rig", "Drift of lenses and cameras",
             format("%zu windows of a flight's stars over %.2f hours; their scatter about the lines has "
                    "&chi;&sup2; %.2f per degree of freedom.",
                    d.windows.size(), (d.windows.back().time - d.windows.front().time) / kHour, d.scatter)) +
         figures_row(figures) + "<h2>Rates</h2>" + table({"", "rate", "&plusmn; (1 &sigma;)"}, rows) +
         "<h2>Windows</h2><div class='charts'>" + charts + "</div>" +
         "<p class='note'>Each window's centre, focal length and turn, from its stars alone, against the "
         "mean of all; "
         "bars are one standard deviation. The first camera's turn is the rig's, and in the attitudes. A "
         "drift is said "
         "to be seen where chance makes one so large once in a thousand times.</p>" +
         page_end();
}

}  // namespace omma::ground
