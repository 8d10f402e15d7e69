// Orbits: Kepler's laws, the drift that a flat Earth makes, and elements there and back.
#include "components/catalogue/orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace omma {
namespace {

constexpr double kDegree = M_PI / 180;

OrbitElements ellipse(bool j2) {
  return {8e6, 0.15, 50 * kDegree, 30 * kDegree, 70 * kDegree, 20 * kDegree, j2};
}

TEST(Orbit, OfTwoBodiesKeepsEnergyAndMomentumAndComesBack) {
  const Orbit orbit(ellipse(false));
  const OrbitState start = orbit.at(0);
  const double energy = -kEarthGravity / (2 * 8e6);
  for (double t = 0; t < orbit.period(); t += 300) {
    const OrbitState state = orbit.at(t);
    EXPECT_NEAR(0.5 * state.velocity.squaredNorm() - kEarthGravity / state.position.norm(), energy,
                1e-9 * std::abs(energy));
    EXPECT_LT((state.position.cross(state.velocity) - start.position.cross(start.velocity)).norm(),
              1e-9 * start.position.cross(start.velocity).norm());
  }
  EXPECT_NEAR(orbit.period(), 2 * M_PI * std::sqrt(std::pow(8e6, 3) / kEarthGravity), 1e-6);
  EXPECT_LT((orbit.at(orbit.period()).position - start.position).norm(), 0.01);
}

TEST(Orbit, VelocityIsTheChangeOfPosition) {
  for (const bool j2 : {false, true}) {
    const Orbit orbit(ellipse(j2));
    for (double t = 100; t < 6000; t += 700) {
      const Eigen::Vector3d measured = (orbit.at(t + 0.05).position - orbit.at(t - 0.05).position) / 0.1;
      EXPECT_LT((measured - orbit.at(t).velocity).norm(), 1e-4) << t;
    }
  }
}

// A sun-synchronous orbit's node goes round once a year: 600 km high, 97.79 degrees inclined.
TEST(Orbit, NodeOfASunSynchronousOrbitGoesRoundInAYear) {
  OrbitElements elements;
  elements.semi_major_axis = kEarthRadius + 600e3;
  elements.inclination = 97.79 * kDegree;
  const Orbit orbit(elements);
  EXPECT_NEAR(orbit.node_rate() * 365.2422 * 86400, 2 * M_PI, 0.01);
}

TEST(Orbit, ElementsGoThroughAStateAndBack) {
  for (const double eccentricity : {0.0, 1e-4, 0.3}) {
    for (const double inclination : {0.0, 0.9, 2.5}) {
      OrbitElements elements = ellipse(true);
      elements.eccentricity = eccentricity;
      elements.inclination = inclination;
      elements.j2 = false;
      const Orbit orbit(elements);
      const Orbit again(elements_through(orbit.at(0), false));
      for (const double t : {0.0, 500.0, 4000.0}) {
        EXPECT_LT((orbit.at(t).position - again.at(t).position).norm(), 1e-3) << eccentricity << inclination;
        EXPECT_LT((orbit.at(t).velocity - again.at(t).velocity).norm(), 1e-6) << eccentricity << inclination;
      }
    }
  }
}

// Clohessy & Wiltshire 1960: set free 100 m further out at the rig's speed, a body drifts by 12 pi times that
// behind the circle in one turn, less what a second order of 100 m over the radius makes.
TEST(Orbit, ABodySetFreeFurtherOutFallsBehind) {
  OrbitElements elements;
  elements.semi_major_axis = 7e6;
  elements.j2 = false;
  const Orbit rig(elements);
  OrbitState state = rig.at(0);
  const double motion = 2 * M_PI / rig.period();
  state.velocity += motion * 100 * state.velocity.normalized();  // turns along with the rig's vertical
  state.position += 100 * state.position.normalized();
  const Orbit other(elements_through(state, false));
  const OrbitState there = rig.at(rig.period());
  const Eigen::Vector3d along = there.velocity.normalized();
  EXPECT_NEAR((other.at(rig.period()).position - there.position).dot(along), -12 * M_PI * 100, 40);
}

TEST(OrbitAxes, PointDownAndForwardAndTurnWithTheOrbit) {
  const Orbit orbit(ellipse(false));
  const OrbitState state = orbit.at(100);
  const Eigen::Matrix3d axes = orbit_axes(state).toRotationMatrix();
  EXPECT_NEAR(axes.col(2).dot(state.position.normalized()), -1, 1e-12);
  EXPECT_GT(axes.col(0).dot(state.velocity.normalized()), 0.9);
  EXPECT_NEAR(axes.determinant(), 1, 1e-12);
  const Eigen::Quaterniond step = orbit_axes(orbit.at(99.5)).conjugate() * orbit_axes(orbit.at(100.5));
  EXPECT_LT((2 * step.vec() - orbit_axes_rate(state)).norm(), 1e-8);
}

}  // namespace
}  // namespace omma
