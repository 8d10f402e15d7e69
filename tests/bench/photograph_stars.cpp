#include "tests/bench/photograph_stars.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/catalogue/star_catalogue.hpp"

namespace omma {
namespace {

constexpr double kNear = 1.5;  // [px]; the lens is known to a quarter of a pixel
constexpr float kFaintest = 8;

bool near(const Dot& dot, const Eigen::Vector2d& pixel) {
  return (dot.pixel - pixel).norm() < kNear;
}

}  // namespace

PhotographStars stars_found(const Photograph& photograph, std::span<const Dot> dots) {
  PhotographStars stars;
  std::filesystem::path truth_file = photograph.images[0];
  truth_file.replace_filename(truth_file.stem().string() + "_truth.json");
  const auto truth = nlohmann::json::parse(std::ifstream(truth_file));
  for (const auto& star : truth.at("stars")) {
    const Eigen::Vector2d pixel(star.at("x").get<double>(), star.at("y").get<double>());
    ++stars.listed;
    stars.found +=
        std::any_of(dots.begin(), dots.end(), [&](const Dot& dot) { return near(dot, pixel); }) ? 1 : 0;
  }
  std::vector<bool> is_star(dots.size(), false);
  const RigCamera& camera = photograph.rig.cameras[0];
  const StarCatalogue catalogue(photograph.observer, {kFaintest, 0});
  for (const SkyStar& star : catalogue.stars()) {
    const Eigen::Vector3d rig = photograph.rig_from_j2000 * star.direction;
    Eigen::Vector2d pixel;
    if (!camera.lens.project(camera.rig_from_camera.rotation.conjugate() * rig, pixel)) continue;
    for (std::size_t i = 0; i < dots.size(); ++i) is_star[i] = is_star[i] || near(dots[i], pixel);
  }
  stars.brightest = std::min(stars.listed, static_cast<int>(dots.size()));
  stars.brightest_are_stars =
      static_cast<int>(std::count(is_star.begin(), is_star.begin() + stars.brightest, true));
  stars.are_stars = static_cast<int>(std::count(is_star.begin(), is_star.end(), true));
  return stars;
}

}  // namespace omma
