// What of the tracking can be changed in flight.
#pragma once

#include <array>

#include "components/tracker/tracker_parameters.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

inline constexpr ParameterDescriptor kTrackerGateChi2{
    .id = 30,
    .name = "tracker.gate_chi2",
    .text = "largest squared distance of a pair, in its variance",
    .value = {.name = "value", .least = 1, .most = 1000}};
inline constexpr ParameterDescriptor kTrackerGateFloor{
    .id = 31,
    .name = "tracker.gate_floor_px",
    .text = "least radius of the gate",
    .value = {.name = "value", .unit = "px", .least = 0, .most = 10}};
inline constexpr ParameterDescriptor kTrackerFaintestStar{
    .id = 32,
    .name = "tracker.faintest_star",
    .text = "faintest star paired",
    .value = {.name = "value", .unit = "mag", .least = 0, .most = 8}};
inline constexpr ParameterDescriptor kTrackerLensError{
    .id = 33,
    .name = "tracker.lens_error_px",
    .text = "lens calibration error, per axis, added to every dot",
    .value = {.name = "value", .unit = "px", .least = 0, .most = 10}};
inline constexpr ParameterDescriptor kTrackerSkyAcceleration{
    .id = 34,
    .name = "tracker.sky_angular_acceleration",
    .text = "of the rig, not modelled",
    .value = {.name = "value", .unit = "rad/s2", .least = 0, .most = 100}};
inline constexpr ParameterDescriptor kTrackerBodyAngular{
    .id = 35,
    .name = "tracker.body_angular_acceleration",
    .text = "of a body relative to the rig, not modelled",
    .value = {.name = "value", .unit = "rad/s2", .least = 0, .most = 100}};
inline constexpr ParameterDescriptor kTrackerBodyLinear{
    .id = 36,
    .name = "tracker.body_linear_acceleration",
    .text = "of a body relative to the rig, not modelled",
    .value = {.name = "value", .unit = "m/s2", .least = 0, .most = 100}};
inline constexpr ParameterDescriptor kTrackerLeastStars{
    .id = 37,
    .name = "tracker.least_star_pairs",
    .text = "fewer beyond chance: the sky is lost and searched again",
    .value = {.name = "value", .type = ValueType::kInteger, .least = 3, .most = 100}};
inline constexpr ParameterDescriptor kTrackerLeastTargets{
    .id = 38,
    .name = "tracker.least_target_pairs",
    .text = "fewer beyond chance: the body is lost and searched again",
    .value = {.name = "value", .type = ValueType::kInteger, .least = 3, .most = 64}};
inline constexpr ParameterDescriptor kTrackerPatience{
    .id = 39,
    .name = "tracker.patience",
    .text = "frame sets a prediction is trusted without a new estimate",
    .value = {.name = "value", .type = ValueType::kInteger, .least = 1, .most = 1000}};

inline constexpr std::array kTrackerParameters{
    kTrackerGateChi2,        kTrackerGateFloor,   kTrackerFaintestStar, kTrackerLensError,
    kTrackerSkyAcceleration, kTrackerBodyAngular, kTrackerBodyLinear,   kTrackerLeastStars,
    kTrackerLeastTargets,    kTrackerPatience};

template <class Visit>
void visit_parameters(TrackerParameters& p, Visit&& visit) {
  visit(kTrackerGateChi2, p.gate.chi2);
  visit(kTrackerGateFloor, p.gate.floor_px);
  visit(kTrackerFaintestStar, p.faintest_star);
  visit(kTrackerLensError, p.floor_px);
  visit(kTrackerSkyAcceleration, p.sky_angular_acceleration);
  visit(kTrackerBodyAngular, p.body_angular_acceleration);
  visit(kTrackerBodyLinear, p.body_linear_acceleration);
  visit(kTrackerLeastStars, p.least_star_pairs);
  visit(kTrackerLeastTargets, p.least_target_pairs);
  visit(kTrackerPatience, p.patience);
}

}  // namespace omma
