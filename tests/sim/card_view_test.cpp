// Bodies with targets: printed discs in the Sun, the shadow side, lamps, faces that hide each other.
#include "sim/card_view.hpp"

#include <gtest/gtest.h>

#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

Target target_at(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, int type) {
  Target target;
  target.id = Name("T" + std::to_string(static_cast<int>(1000 * position.x())) + "_" +
                   std::to_string(static_cast<int>(1000 * position.z())));
  target.position = position;
  target.normal = normal;
  target.type = type;
  return target;
}

/// A white plate of a metre, square to the axis, two metres before the camera; in the rig's frame.
Card white_plate() {
  Card card;
  card.body.name = Name("card");
  card.faces = {{Pose{}, 1, 1}};
  card.printed = Printed{0.5, 0.9, 60};
  card.disc_diameter = 0.1;
  card.motion = Motion::constant({Eigen::Quaterniond(0, 1, 0, 0), {0, 0, 2}}, {0, 0, 0}, {0, 0, 0});
  card.face_of = faces_of(card.body, card.faces);
  return card;
}

double surface(double albedo, double cosine) {  // electrons in a pixel on the axis
  return 1e3 * std::pow(10, 0.4 * 26.74) * albedo * cosine / M_PI / (150.0 * 150.0);
}

Scenario lit_from(double angle) {  // from behind the camera, to the right in the image
  Scenario scenario = one_camera();
  scenario.sun = Disc{{-std::cos(angle), -std::sin(angle), 0}, 0.0093, -26.74};
  scenario.cards.push_back(white_plate());
  return scenario;
}

TEST(Card, InTheSunIsAsBrightAsLambertHasIt) {
  for (const double angle : {0.0, 40.0, 80.0}) {
    const Drawn drawn = draw(lit_from(angle * kDegree));
    EXPECT_NEAR(drawn.at(199, 199) / surface(0.5, std::cos(angle * kDegree)), 1, 1e-3) << angle;
  }
}

TEST(Card, IsDarkOnItsShadowSideButForWhatLightThereIs) {
  Scenario scenario = lit_from(120 * kDegree);
  EXPECT_LT(draw(scenario).at(199, 199), 1e-9 * surface(0.5, 1));
  scenario.cards[0].printed->ambient = 10;
  const double arcsec2 = std::pow(180 * 3600 / M_PI / 150, 2);
  EXPECT_NEAR(draw(scenario).at(199, 199) / (0.5 * 1e3 * 1e-4 * arcsec2), 1, 1e-3);
}

TEST(Card, ShowsItsBackInTheSunThatShinesOnIt) {
  Scenario scenario = lit_from(30 * kDegree);
  scenario.cards[0].motion =
      Motion::constant({Eigen::Quaterniond::Identity(), {0, 0, 2}}, {0, 0, 0}, {0, 0, 0});  // turned away
  EXPECT_NEAR(draw(scenario).at(199, 199) / surface(0.5, std::cos(30 * kDegree)), 1, 1e-3);
}

TEST(Card, PrintedDiscsStandOutByTheirAlbedo) {
  Scenario scenario = lit_from(0);
  Card& card = scenario.cards[0];
  card.disc_diameter = 0.4;
  ASSERT_TRUE(card.body.targets.push_back(target_at({0, 0, 0}, {0, 0, 0}, 1)));
  card.face_of = faces_of(card.body, card.faces);
  EXPECT_NEAR(draw(scenario).at(199, 199) / surface(0.9, 1), 1, 0.01);
}

TEST(Card, LampFallsWithTheCosineToItsOrderAndTheSquareOfTheDistance) {
  Scenario scenario = one_camera();
  Card card = white_plate();
  ASSERT_TRUE(card.body.targets.push_back(target_at({0, 0, 0}, {0, 0, 1}, 1)));
  card.face_of = faces_of(card.body, card.faces);
  card.disc_diameter = 0.005;
  card.led = Led{-10, 3};
  const auto light = [&](double turn, double distance) {
    card.motion =
        Motion::constant({Eigen::Quaterniond(0, 1, 0, 0) * rotation_exp({0, turn, 0}), {0, 0, distance}},
                         {0, 0, 0}, {0, 0, 0});
    scenario.cards = {card};
    return draw(scenario).sum();
  };
  const double straight = light(0, 1);
  EXPECT_NEAR(straight / (1e3 * 1e4), 1, 0.01);
  EXPECT_NEAR(light(0, 2) / straight, 0.25, 0.003);
  EXPECT_NEAR(light(50 * kDegree, 1) / straight, std::pow(std::cos(50 * kDegree), 3), 0.003);
}

/// A cube of 0.4 m with a lamp in the middle of each face; face k is along k/2's axis, + then −.
Card cube() {
  Card card = white_plate();
  card.led = Led{-10, 1};
  card.faces.clear();
  for (int k = 0; k < 6; ++k) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    normal[k / 2] = k % 2 == 0 ? 1 : -1;
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
    card.faces.push_back({{turn, 0.2 * normal}, 0.4, 0.4});
    EXPECT_TRUE(card.body.targets.push_back(target_at(0.2 * normal, normal, 1)));
  }
  card.face_of = faces_of(card.body, card.faces);
  return card;
}

TEST(Faces, EachTargetIsOnItsOwn) {
  const Card card = cube();
  for (std::size_t t = 0; t < 6; ++t) EXPECT_EQ(card.face_of[t], t);
}

TEST(Faces, OfACubeShowThreeAtMostAndEachInItsOwnLight) {
  Scenario scenario = one_camera();
  scenario.sun = Disc{{-std::cos(0.6), -std::sin(0.6), 0}, 0.0093, -26.74};
  Card card = cube();
  card.led.reset();
  // A corner towards the camera.
  const Eigen::Quaterniond turn = rotation_exp({0, 45 * kDegree, 0});
  card.motion = Motion::constant({turn, {0, 0, 2}}, {0, 0, 0}, {0, 0, 0});
  scenario.cards = {card};
  const Drawn drawn = draw(scenario);
  EXPECT_EQ(drawn.truth.size(), 2U);  // the corner hides all but two faces
  const double left = drawn.at(199 - 12, 189) / surface(0.5, 1);
  const double right = drawn.at(199 + 12, 189) / surface(0.5, 1);
  EXPECT_NEAR(right, std::cos(45 * kDegree - 0.6), 0.03);
  EXPECT_NEAR(left, std::cos(45 * kDegree + 0.6), 0.03);
  // Where the two meet there is no seam.
  for (int u = 196; u <= 203; ++u) EXPECT_GT(drawn.at(u, 189) / surface(0.5, 1), left - 0.02) << u;
}

TEST(Faces, HideTheTargetsOfAnotherBehindThem) {
  Scenario scenario = one_camera();
  Card card = white_plate();
  card.led = Led{-10, 1};
  card.faces.push_back(
      {{Eigen::Quaterniond::Identity(), {0.3, 0, 0.5}}, 0.3, 0.3});  // a flap over the right half
  ASSERT_TRUE(card.body.targets.push_back(target_at({0.3, 0, 0}, {0, 0, 1}, 1)));
  ASSERT_TRUE(card.body.targets.push_back(target_at({-0.3, 0, 0}, {0, 0, 1}, 1)));
  card.face_of = faces_of(card.body, card.faces);
  scenario.cards = {card};
  const Drawn drawn = draw(scenario);
  ASSERT_EQ(drawn.truth.size(), 1U);
  EXPECT_EQ(drawn.truth[0].spot.target, 1);
}

// The Sun stands 45 degrees to the right in the image; a flap at the plate's right edge, square to it and as
// high as a quarter of a metre, throws a shadow as wide.
Scenario with_flap() {
  Scenario scenario = lit_from(45 * kDegree);
  Card& card = scenario.cards[0];
  card.faces.push_back({{rotation_exp({0, 90 * kDegree, 0}), {0.5, 0, 0.125}}, 0.25, 1});
  card.printed->ambient = 5;
  return scenario;
}

TEST(Shadow, OfAFaceIsAsWideAsItsHeightTimesTheSunsTangent) {
  const Drawn drawn = draw(with_flap());
  Scenario flat = with_flap();
  flat.cards[0].faces.pop_back();
  const Drawn lit = draw(flat);
  flat.sun.reset();
  const Drawn dark = draw(flat);
  const double edge = 199.5 + 150 * std::atan(0.25 / 2);  // of the shadow, 0.25 m right of the middle
  for (int u = 180; u < 199 + 150 * std::atan(0.45 / 2); ++u) {
    if (std::abs(u - edge) < 4) continue;  // the spread of the point
    const Drawn& as = u < edge ? lit : dark;
    EXPECT_NEAR(drawn.at(u, 199) / as.at(u, 199), 1, 1e-3) << u;
  }
}

TEST(Shadow, DarkensTheDiscsInIt) {
  const auto light = [](double x, bool flap) {
    Scenario scenario = with_flap();
    Card& card = scenario.cards[0];
    card.printed->ambient = 60;
    if (!flap) card.faces.pop_back();
    const double plate = draw(scenario).sum();
    EXPECT_TRUE(card.body.targets.push_back(target_at({x, 0, 0}, {0, 0, 1}, 1)));
    card.face_of = faces_of(card.body, card.faces);
    return draw(scenario).sum() - plate;
  };
  EXPECT_NEAR(light(0.1, true) / light(0.1, false), 1, 1e-3);
  EXPECT_LT(light(0.4, true) / light(0.4, false), 1e-3);
}

TEST(Shadow, FallsFromOneBodyOnAnother) {
  Scenario scenario = lit_from(60 * kDegree);
  Card screen =
      white_plate();  // 0.4 m wide, on the line from the plate's middle to the Sun, out of its sight
  screen.faces = {{Pose{}, 0.4, 0.4}};
  const Eigen::Vector3d to_sun(std::sin(60 * kDegree), 0, -std::cos(60 * kDegree));
  const Eigen::Vector3d place = Eigen::Vector3d(0, 0, 2) + 1.2 * to_sun;
  screen.motion = Motion::constant(
      {Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to_sun), place}, {0, 0, 0}, {0, 0, 0});
  const double lit = draw(scenario).at(199, 199);
  scenario.cards.push_back(screen);
  const Drawn drawn = draw(scenario);
  EXPECT_LT(drawn.at(199, 199) / lit, 1e-6);
  EXPECT_NEAR(drawn.at(199 - 35, 199) / draw(lit_from(60 * kDegree)).at(199 - 35, 199), 1, 1e-3);
}

TEST(Card, InTheEarthsShadowIsDark) {
  Scenario scenario = lit_from(0);
  scenario.sun->direction = {-1, 0, 0};
  OrbitElements elements;
  elements.semi_major_axis = 7e6;
  elements.j2 = false;
  scenario.orbit = Orbit(elements);  // on the x axis: midnight
  EXPECT_LT(draw(scenario).at(199, 199), 1e-9 * surface(0.5, 1));
}

}  // namespace
}  // namespace omma::sim
