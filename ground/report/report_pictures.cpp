#include "ground/report/report_pictures.hpp"

#include <algorithm>
#include <numbers>

#include "components/catalogue/solar_system.hpp"
#include "components/imaging/panorama.hpp"
#include "ground/draw/labels.hpp"
#include "ground/draw/sky_grid.hpp"
#include "ground/draw/star_text.hpp"
#include "ground/draw/stretch.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

constexpr Colour kStar{0.45, 0.95, 0.55, 0.9};
constexpr Colour kTarget{0.4, 0.75, 1.0, 0.95};
constexpr Colour kSolar{1.0, 0.75, 0.25, 0.95};
constexpr Colour kObject{0.95, 0.45, 0.95, 0.95};
constexpr Colour kCulled{1.0, 0.35, 0.3, 0.95};
constexpr Colour kUnpaired{0.7, 0.7, 0.7, 0.45};
constexpr Colour kName{1.0, 0.92, 0.7, 1.0};
constexpr double kNamedStar = 2.2;  // V: fainter stars stay without a name in the panorama
constexpr int kNamedDots = 25;      // stars named in a camera's frame

/// Whether any camera saw the sky there: unseen parts of a panorama are 0.
bool seen(const GreyPicture& panorama, const Eigen::Vector2d& at) {
  constexpr int kReach = 2;
  const int u = static_cast<int>(at.x());
  const int v = static_cast<int>(at.y());
  for (int row = std::max(0, v - kReach); row <= std::min(panorama.height - 1, v + kReach); ++row) {
    for (int column = std::max(0, u - kReach); column <= std::min(panorama.width - 1, u + kReach); ++column) {
      const std::size_t index = static_cast<std::size_t>(row) * static_cast<std::size_t>(panorama.width) +
                                static_cast<std::size_t>(column);
      if (panorama.pixels[index] > 0) return true;
    }
  }
  return false;
}

struct Tally {
  int stars = 0;
  int targets = 0;
  int solar = 0;
  int objects = 0;
  int culled = 0;
  int unpaired = 0;
};

void mark(Canvas& canvas, const omma_Dot& dot, int scale, Tally& tally) {
  const Eigen::Vector2d at(scale * (dot.u_px + 0.5) - 0.5, scale * (dot.v_px + 0.5) - 0.5);
  if (dot.role == omma_DOT_UNPAIRED) {
    ++tally.unpaired;
    canvas.circle(at, 4, kUnpaired, 1);
  } else if (dot.culled) {
    ++tally.culled;
    canvas.circle(at, 6, kCulled, 1.4);
  } else if (dot.role == omma_DOT_STAR) {
    ++tally.stars;
    canvas.circle(at, 6, kStar, 1.2);
  } else if (dot.role == omma_DOT_SOLAR_BODY) {
    ++tally.solar;
    canvas.circle(at, 9, kSolar, 1.4);
  } else if (dot.role == omma_DOT_OBJECT) {
    ++tally.objects;
    canvas.circle(at, 9, kObject, 1.4);
  } else {
    ++tally.targets;
    canvas.circle(at, 7, kTarget, 1.4);
  }
}

void name(Labels& labels, const omma_Dot& dot, int scale, const FlownMission& mission) {
  const Eigen::Vector2d at(scale * (dot.u_px + 0.5) - 0.5, scale * (dot.v_px + 0.5) - 0.5);
  if (dot.role == omma_DOT_STAR) {
    labels.place(at, 7, star_text(dot.entry), 12, kName);
  } else if (dot.role == omma_DOT_SOLAR_BODY) {
    labels.place(at, 10, std::string(solar_body_name(dot.entry)), 13, kSolar);
  } else if (dot.role == omma_DOT_OBJECT) {
    labels.place(at, 10, "object " + std::to_string(dot.entry), 12, kObject);
  } else if (dot.body < mission.bodies.size() && dot.entry < mission.bodies[dot.body].targets.size()) {
    labels.place(at, 8, mission.bodies[dot.body].targets[dot.entry].id.view(), 12, kTarget);
  }
}

}  // namespace

Canvas panorama_picture(const ChunkPicture& panorama, const StarCatalogue& catalogue) {
  Canvas canvas(panorama.picture);
  Labels labels(canvas);
  const int width = panorama.picture.width;
  const SkyProjection projection = [width](const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) {
    pixel = panorama_pixel(direction, width);
    return true;
  };
  draw_sky_grid(canvas, labels, sky_grid(projection, {30, 30}, 0.2 * width), 12);
  for (const SkyStar& star : catalogue.stars()) {
    if (star.magnitude > kNamedStar) continue;
    const Eigen::Vector2d at = panorama_pixel(star.direction, width);
    if (!seen(panorama.picture, at)) continue;
    canvas.circle(at, 5, kStar, 1);
    labels.place(at, 6, star_text(star.hr), 12, kName);
  }
  return canvas;
}

Canvas camera_picture(const std::filesystem::path& image_file, const FlownMission& mission,
                      const std::vector<omma_Dot>& dots, const std::string& camera, std::uint64_t frame) {
  const Image image = read_image(image_file);
  constexpr int kFooter = 24;
  const int scale = image.width < 900 ? 2 : 1;
  Canvas canvas(stretched(image.view(), night_sky_stretch(image.view())), scale, kFooter);
  Labels labels(canvas);
  Tally tally;
  for (const omma_Dot& dot : dots) mark(canvas, dot, scale, tally);
  int named = 0;
  for (const omma_Dot& dot : dots) {  // brightest first
    if (dot.role == omma_DOT_UNPAIRED || dot.culled) continue;
    if (dot.role == omma_DOT_STAR && ++named > kNamedDots) continue;
    name(labels, dot, scale, mission);
  }
  const double baseline = canvas.height() - 8;
  double x = 8;
  const auto legend = [&](const std::string& text, const Colour& colour) {
    canvas.text({x, baseline}, text, 14, colour);
    x = canvas.text_box({x, baseline}, text, 14).right + 22;
  };
  legend(camera + ", frame set " + std::to_string(frame), kName);
  legend(std::to_string(tally.stars) + " stars", kStar);
  if (tally.targets > 0) legend(std::to_string(tally.targets) + " targets", kTarget);
  if (tally.solar > 0) legend(std::to_string(tally.solar) + " Sun, Moon, planets", kSolar);
  if (tally.objects > 0) legend(std::to_string(tally.objects) + " objects", kObject);
  legend(std::to_string(tally.culled) + " culled", kCulled);
  legend(std::to_string(tally.unpaired) + " unpaired", kUnpaired.with_alpha(1));
  return canvas;
}

}  // namespace omma::ground
