// The repetition experiment's figures: each trial's rms per axis, how it spreads between trials, and the
// scatter of all errors.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/experiment/docking.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kAxes = DockingAxes::RowsAtCompileTime;
constexpr const char* kNames[kAxes] = {"rotation x", "rotation y", "rotation z", "position x", "position y",
                                       "position z", "attitude x", "attitude y", "attitude z"};

double unit(int axis) {
  if (axis < 3) return kDegree;
  return axis < 6 ? 1e-3 : kDegree / 3600;
}
const char* unit_name(int axis) {
  if (axis < 3) return "deg";
  return axis < 6 ? "mm" : "arcsec";
}

DockingAxes rms_of(const DockingTrial& t) {
  DockingAxes rms;
  rms << t.pose.rms, t.attitude.rms;
  return rms;
}
DockingAxes bound_of_trial(const DockingTrial& t) {
  DockingAxes bound;
  bound << t.pose.bound_rms, t.attitude.bound_rms;
  return bound;
}

std::vector<double> in_units(const DockingAxes& v) {
  std::vector<double> values;
  values.reserve(kAxes);
  for (int axis = 0; axis < kAxes; ++axis) values.push_back(v[axis] / unit(axis));
  return values;
}

// How far the rms is from the bound, on the mean of all trials, and how well that is known.
struct OverTheBound {
  double ratio = 0;
  double sigma = 0;
};
OverTheBound over_the_bound(const TrialSpread& s, int axis) {
  if (!(s.bound[axis] > 0)) return {};
  return {s.mean[axis] / s.bound[axis],
          s.deviation[axis] / s.bound[axis] / std::sqrt(static_cast<double>(s.rms.size()))};
}

// Points with many near them are drawn last and in the other colour: the density of the dissertation's
// figure 80.
std::string density_scatter(const std::vector<DockingTrial>& trials, int first, const std::string& title) {
  std::vector<Eigen::Vector2d> points;
  for (const DockingTrial& t : trials) {
    for (const PoseError& p : t.pose.points)
      points.emplace_back(p.error[first] / unit(first), p.error[first + 1] / unit(first));
  }
  double spread = 0;
  for (const Eigen::Vector2d& p : points) spread = std::max(spread, p.cwiseAbs().maxCoeff());
  XySeries sparse{"sparse", "b", Mark::kPoints, {}};
  XySeries dense{"dense", "a", Mark::kPoints, {}};
  const double radius = spread / 12;
  std::vector<int> neighbours;
  neighbours.reserve(points.size());
  for (const Eigen::Vector2d& p : points) {
    neighbours.push_back(static_cast<int>(std::count_if(
        points.begin(), points.end(), [&](const Eigen::Vector2d& q) { return (p - q).norm() < radius; })));
  }
  std::vector<int> sorted = neighbours;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    (neighbours[i] >= *middle ? dense : sparse).points.push_back(points[i]);
  XyChart chart{title,
                {format("x [%s]", unit_name(first)), false, -spread, spread},
                {format("y [%s]", unit_name(first)), false, -spread, spread},
                {sparse, dense},
                true};
  return xy_chart(chart);
}

}  // namespace

TrialSpread trial_spread(const std::vector<DockingTrial>& trials) {
  TrialSpread spread;
  const auto count = static_cast<double>(trials.size());
  double frames = 0;
  for (const DockingTrial& t : trials) {
    spread.rms.push_back(rms_of(t));
    spread.mean += spread.rms.back() / count;
    spread.bound += bound_of_trial(t).cwiseAbs2() / count;
    frames += double(t.pose.points.size()) / count;
  }
  spread.bound = spread.bound.cwiseSqrt();
  for (const DockingAxes& rms : spread.rms) spread.deviation += (rms - spread.mean).cwiseAbs2();
  if (trials.size() > 1) spread.deviation = (spread.deviation / (count - 1)).cwiseSqrt();
  spread.expected_deviation = spread.mean / std::sqrt(2 * std::max(1.0, frames));
  return spread;
}

std::string repetition_text(const std::vector<DockingTrial>& trials) {
  const TrialSpread s = trial_spread(trials);
  std::string text =
      "trial  rotation x, y, z [deg]      position x, y, z [mm]       attitude x, y, z [\"]      of range "
      "[%]  NEES\n";
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::vector<double> v = in_units(s.rms[i]);
    text += format("%5zu  %8.4f %8.4f %8.4f  %8.4f %8.4f %8.4f  %8.2f %8.2f %8.2f  %8.4f  %6.2f\n", i + 1,
                   v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8],
                   100 * trials[i].pose.position_part.rms, trials[i].pose.nees.mean);
  }
  const auto line = [&](const char* name, const DockingAxes& x) {
    const std::vector<double> v = in_units(x);
    text += format("%5s  %8.4f %8.4f %8.4f  %8.4f %8.4f %8.4f  %8.2f %8.2f %8.2f\n", name, v[0], v[1], v[2],
                   v[3], v[4], v[5], v[6], v[7], v[8]);
  };
  line("mean", s.mean);
  line(trials.front().reference.knows_spots ? "bound" : "own", s.bound);
  line("sigma", s.deviation);
  line("chance", s.expected_deviation);
  text += format("rms / %s of all trials:\n", trials.front().reference.bound_name());
  for (int axis = 0; axis < kAxes; ++axis) {
    const OverTheBound over = over_the_bound(s, axis);
    text += format("%s %.3f +- %.3f%s", kNames[axis], over.ratio, over.sigma, axis % 3 == 2 ? "\n" : ", ");
  }
  return text;
}

std::string repetition_json(const std::vector<DockingTrial>& trials) {
  const TrialSpread s = trial_spread(trials);
  nlohmann::ordered_json json{
      {"experiment", "repetition"},
      {"recorded", trials.front().reference.recorded},
      {"bound_from", trials.front().reference.bound_name()},
      {"axes", kNames},
      {"units", {"deg", "deg", "deg", "mm", "mm", "mm", "arcsec", "arcsec", "arcsec"}}};
  json["trials"] = nlohmann::ordered_json::array();
  for (const DockingTrial& t : trials) {
    json["trials"].push_back({{"rms", in_units(rms_of(t))},
                              {"bound_rms", in_units(bound_of_trial(t))},
                              {"position_rms_of_range", t.pose.position_part.rms},
                              {"solved", t.pose.points.size()},
                              {"frames", t.pose.frames},
                              {"wrong_pairings", t.pairs.wrong},
                              {"nees", t.pose.nees.mean}});
  }
  json["mean"] = in_units(s.mean);
  json["bound"] = in_units(s.bound);
  for (int axis = 0; axis < kAxes; ++axis) {
    const OverTheBound over = over_the_bound(s, axis);
    json["rms_over_bound"].push_back(over.ratio);
    json["rms_over_bound_sigma"].push_back(over.sigma);
  }
  json["deviation_between_trials"] = in_units(s.deviation);
  json["deviation_that_chance_makes"] = in_units(s.expected_deviation);
  return json.dump(2) + "\n";
}

std::string repetition_page(const std::vector<DockingTrial>& trials) {
  const TrialSpread s = trial_spread(trials);
  std::string figures;
  for (int axis = 0; axis < kAxes; ++axis) {
    figures +=
        figure(format("%.3g %s", s.mean[axis] / unit(axis), unit_name(axis)),
               format("%s: mean rms of %zu trials, %.2f times the %s; between trials &plusmn; %.1f %% where "
                      "chance makes %.1f %%",
                      kNames[axis], trials.size(), over_the_bound(s, axis).ratio,
                      trials.front().reference.bound_name(), 100 * s.deviation[axis] / s.mean[axis],
                      100 * s.expected_deviation[axis] / s.mean[axis]));
  }
  std::string charts;
  for (int axis = 0; axis < kAxes; ++axis) {
    XySeries rms{"rms", "a", Mark::kPoints, {}};
    XySeries bound{trials.front().reference.bound_name(), "b", Mark::kDashed, {}};
    for (std::size_t i = 0; i < trials.size(); ++i) {
      rms.points.emplace_back(i + 1, s.rms[i][axis] / unit(axis));
      bound.points.emplace_back(i + 1, bound_of_trial(trials[i])[axis] / unit(axis));
    }
    const double top = 1.5 * s.mean[axis] / unit(axis);
    charts += xy_chart({kNames[axis],
                        {"trial", false, 0, double(trials.size() + 1)},
                        {format("rms [%s]", unit_name(axis)), false, 0, top},
                        {rms, bound}});
  }
  charts += density_scatter(trials, 3, "Position error of all trials");
  charts += density_scatter(trials, 0, "Rotation error of all trials");
  return page_head("Omma: repetition", "Repetition experiment",
                   format("The same docking run, %zu times.", trials.size())) +
         figures_row(figures) + "<h2>Trials</h2><div class='charts'>" + charts + "</div>" +
         "<p class='note'>" + trials.front().reference.note() +
         (trials.front().reference.recorded
              ? " "
              : " Every trial has its own noise and stands slightly elsewhere. ") +
         "A trial's rms "
         "is known to 1/&radic;(2 n) of itself, n its number of frame sets: a spread between trials beyond "
         "that would "
         "be the system's.</p>" +
         page_end();
}

}  // namespace omma::ground
