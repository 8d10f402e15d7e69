// The page of a design study: the trade of cameras against field of view, and one rig in figures.
#include <cmath>
#include <numbers>

#include "ground/design/design_study.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsec = kDegree / 3600;
constexpr int kDistances = 25;

// Field of view against the distance beyond which the sky is whole, a line for each number of cameras.
std::string trade_chart(double spacing) {
  XyChart chart;
  chart.title = format("Field of view for the whole sky, neighbours %g m apart", spacing);
  chart.x = {"whole sky beyond [m]", true, spacing, 100 * spacing};
  chart.y = {"field of view needed [&deg;]", false, 0, 0};
  for (int cameras = kFewestSymmetric; cameras <= kMostSymmetric; ++cameras) {
    XySeries series{format("%d cameras", cameras), cameras % 2 == 0 ? "a" : "b", Mark::kLine, {}};
    const std::vector<CameraPlace> places = symmetric_places(cameras, spacing);
    for (int k = 0; k <= kDistances; ++k) {
      const double distance = spacing * std::pow(100.0, double(k) / kDistances);
      series.points.emplace_back(distance, needed_field(places, distance).field / kDegree);
    }
    chart.series.push_back(series);
  }
  return "<div class='charts'>" + xy_chart(chart) + "</div>";
}

std::string symmetric_section(const std::vector<SymmetricRow>& rows, double spacing, double distance) {
  std::vector<std::vector<std::string>> cells;
  cells.reserve(rows.size());
  for (const SymmetricRow& row : rows) {
    cells.push_back({format("%d, %s", row.cameras, symmetric_name(row.cameras)),
                     format("%.1f&deg;", row.needed.field / kDegree),
                     format("%.1f&deg;", row.needed_infinity.field / kDegree)});
  }
  return format("<h2>Symmetric rigs, neighbours %g m apart</h2>", spacing) +
         table({"cameras", format("field of view, whole sky beyond %g m", distance), "at infinity"}, cells) +
         trade_chart(spacing);
}

std::string headline(const DesignStudy& s) {
  return figures_row(
      figure(
          format("%.2f %%", 100 * s.infinity.seen()),
          format("of the sky seen at infinity, %.2f %% at %g m", 100 * s.near.seen(), s.options.distance)) +
      figure(s.whole_sky_beyond ? format("%.2f m", *s.whole_sky_beyond) : "never",
             "distance beyond which the whole sky is seen") +
      figure(format("%.1f", s.sky.all_stars.mean),
             format("stars to V %.2f on average; at the worst of 500 attitudes %.0f", s.options.magnitude,
                    s.sky.all_stars.least)) +
      figure(format("%.1f&Prime;", s.sky.attitude_sigma.median / kArcsec),
             format("attitude &sigma; of an axis, median over attitudes, dots %g px; worst %.1f&Prime;",
                    s.options.dot_sigma, s.sky.attitude_sigma.most / kArcsec)));
}

std::string cameras_table(const DesignStudy& s) {
  std::vector<std::vector<std::string>> cells;
  for (std::size_t c = 0; c < s.paper.rig.cameras.size(); ++c) {
    const RigCamera& camera = s.paper.rig.cameras[c];
    const Spread& stars = s.sky.stars[c];
    std::vector<std::string> row{std::string(camera.name.view()),
                                 format("%d &times; %d", camera.lens.width(), camera.lens.height()),
                                 format("%.1f&deg;", s.paper.reach(c) / kDegree),
                                 format("%.0f&Prime;", camera.lens.pixel_angle() / kArcsec),
                                 format("%.1f", stars.mean),
                                 format("%.0f to %.0f", stars.low, stars.high)};
    if (!s.body.empty()) {
      const auto& pose = s.poses[c];
      row.push_back(pose ? format("%.2f mm", 1e3 * pose->position_sigma) : "none");
      row.push_back(pose ? format("%.3f&deg;", pose->rotation_sigma / kDegree) : "none");
    }
    cells.push_back(row);
  }
  std::vector<std::string> heads{"camera",      "pixels",      "largest angle off axis",
                                 "pixel scale", "stars, mean", "stars, 5 % to 95 %"};
  if (!s.body.empty()) {
    heads.push_back(format("%s at %g m, position &sigma;", s.body.c_str(), s.options.range));
    heads.emplace_back("rotation &sigma;");
  }
  return "<h2>Cameras</h2>" + table(heads, cells);
}

}  // namespace

std::string study_page(const std::vector<SymmetricRow>& rows, double spacing, double distance,
                       const DesignStudy* s, const std::vector<std::uint8_t>& coverage_png) {
  std::string html =
      page_head("Omma: rig design", s == nullptr ? "Rig design" : escaped(s->paper.rig.name.c_str()),
                "Number, placement and field of view of cameras that see the whole sky.");
  if (s != nullptr) {
    html += headline(*s) + "<h2>Coverage</h2>" +
            picture(coverage_png,
                    format("Cameras that see each direction at %g m; rig frame, +x in the middle, +z up. "
                           "Circles: the cameras' axes. Numbers: blind spots, largest first.",
                           s->near.distance));
    html += cameras_table(*s);
    html += format(
        "<p class='note'>Circular lenses at these places need %.1f&deg; to see the whole sky beyond %g m, "
        "and %.1f&deg; at infinity. Centres of the cameras within %.3f &times; %.3f &times; %.3f m. "
        "Deviations are Cram&eacute;r&ndash;Rao bounds for dots of %g px.</p>",
        s->needed.field / kDegree, s->options.distance, s->needed_infinity.field / kDegree, s->box.x(),
        s->box.y(), s->box.z(), s->options.dot_sigma);
  }
  return html + symmetric_section(rows, spacing, distance) + page_end();
}

}  // namespace omma::ground
