#include "components/imaging/mosaic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omma {
namespace {

constexpr int kLargestBox = 15;  // [px] bounds the work of one output pixel

// Mean of the largest of n² pixels of normal noise, in its standard deviations, by n: what the brightest of a
// box is above its background by chance. Source: H. L. Harter, "Expected values of normal order statistics",
// Biometrika 48 (1961).
constexpr std::array<double, kLargestBox + 1> kPeakOfNoise{0,      0,      1.0294, 1.4850, 1.7660, 1.9653,
                                                           2.1181, 2.2408, 2.3437, 2.4316, 2.5076, 2.5746,
                                                           2.6345, 2.6882, 2.7371, 2.7819};

/// Grey levels as they are, or made even.
using EvenLevels = std::span<const std::uint16_t>;

template <class Pixel>
int level_of(Pixel grey, EvenLevels even) {
  return even.empty() ? grey : even[grey];
}

template <class Pixel>
double interpolated(const ImageView& image, double u, double v, EvenLevels even) {
  const double x = std::clamp(u, 0.0, image.width - 1.0);
  const double y = std::clamp(v, 0.0, image.height - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(image.width - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(image.height - 2, 0));
  const int right = std::min(column + 1, image.width - 1);
  const Pixel* top = image.row<Pixel>(row);
  const Pixel* bottom = image.row<Pixel>(std::min(row + 1, image.height - 1));
  const double a = x - column;
  const double b = y - row;
  return (1 - b) * ((1 - a) * level_of(top[column], even) + a * level_of(top[right], even)) +
         b * ((1 - a) * level_of(bottom[column], even) + a * level_of(bottom[right], even));
}

template <class Pixel>
double over_box(const ImageView& image, double u, double v, int box, Footprint footprint, EvenLevels even) {
  const int left = static_cast<int>(std::lround(u - 0.5 * (box - 1)));
  const int top = static_cast<int>(std::lround(v - 0.5 * (box - 1)));
  const int right = std::min(left + box, image.width);
  const int bottom = std::min(top + box, image.height);
  double sum = 0;
  int peak = 0;
  int count = 0;
  for (int row = std::max(top, 0); row < bottom; ++row) {
    const Pixel* pixels = image.row<Pixel>(row);
    for (int column = std::max(left, 0); column < right; ++column) {
      const int level = level_of(pixels[column], even);
      sum += level;
      peak = std::max(peak, level);
      ++count;
    }
  }
  if (count == 0) return interpolated<Pixel>(image, u, v, even);
  return footprint == Footprint::kMean ? sum / count : peak;
}

bool usable(const ImageView& image, const RayTable& table, int camera) {
  return !image.empty() && image.width == table.width(camera) && image.height == table.height(camera);
}

template <class Pixel>
double grey(const ImageView& image, const SeenPixel& seen, int box, Footprint footprint, EvenLevels even) {
  return box <= 1 ? interpolated<Pixel>(image, seen.u, seen.v, even)
                  : over_box<Pixel>(image, seen.u, seen.v, box, footprint, even);
}

double grey_of(const ImageView& image, const SeenPixel& seen, int box, Footprint footprint,
               EvenLevels even = {}) {
  return image.format == PixelFormat::kGrey8 ? grey<std::uint8_t>(image, seen, box, footprint, even)
                                             : grey<std::uint16_t>(image, seen, box, footprint, even);
}

}  // namespace

std::array<int, limits::kCameras> Mosaic::boxes(double angle) const noexcept {
  std::array<int, limits::kCameras> boxes{};
  for (int camera = 0; camera < table_.cameras(); ++camera) {
    const double pixels = angle / table_.pixel_angle(camera);
    boxes[camera] = static_cast<int>(std::clamp(std::round(pixels), 1.0, 1.0 * kLargestBox));
  }
  return boxes;
}

double Mosaic::light(const Eigen::Vector3d& direction, RigImages images,
                     const std::array<int, limits::kCameras>& boxes, OverlapSums* sums) const noexcept {
  std::array<SeenPixel, limits::kCameras> seen;
  table_.look(direction, seen);
  double weighted = 0;
  double weights = 0;
  int last = -1;  // camera seen before this one, for the overlap
  double last_value = 0;
  for (int camera = 0; camera < table_.cameras(); ++camera) {
    if (!(seen[camera].weight > 0) || static_cast<std::size_t>(camera) >= images.size()) continue;
    const ImageView& image = images[camera];
    if (!usable(image, table_, camera)) continue;
    const CameraLevels& levels = levels_[camera];
    const double share = grey_of(image, seen[camera], boxes[camera], footprint_) / image.white_level;
    const double by_chance =
        footprint_ == Footprint::kPeak ? kPeakOfNoise[static_cast<std::size_t>(boxes[camera])] : 0;
    const double value = levels.scale * (share - levels.black - by_chance * levels.noise);
    weighted += seen[camera].weight * levels.gain * value;
    weights += seen[camera].weight;
    if (sums == nullptr || share >= 1) continue;  // a full pixel says nothing about its gain
    if (last >= 0) sums->add(last, last_value, camera, value);
    last = camera;
    last_value = value;
  }
  return weights > 0 ? weighted / weights : std::numeric_limits<double>::quiet_NaN();
}

void Mosaic::gather(const Eigen::Vector3d& direction, RigImages images, const RigExposed& exposed,
                    const std::array<int, limits::kCameras>& boxes, FusedLight& to) const noexcept {
  std::array<SeenPixel, limits::kCameras> seen;
  table_.look(direction, seen);
  for (int camera = 0; camera < table_.cameras(); ++camera) {
    const CameraExposed& how = exposed[camera];
    if (!(seen[camera].weight > 0) || !(how.exposure > 0) ||
        static_cast<std::size_t>(camera) >= images.size())
      continue;
    const ImageView& image = images[camera];
    if (!usable(image, table_, camera)) continue;
    // One full pixel among those that are averaged hides how bright it was: two at least, where it is
    // interpolated.
    const int box = boxes[camera];
    to.add({.level = grey_of(image, seen[camera], box, Footprint::kMean, how.even),
            .brightest = grey_of(image, seen[camera], std::max(box, 2), Footprint::kPeak, how.even),
            .white = how.white,
            .black = how.black,
            .exposure = how.exposure},
           how.sensor, how.unit * levels_[camera].gain, seen[camera].weight);
  }
}

std::uint8_t companded(double light, double white, double soft) noexcept {
  if (std::isnan(light)) return 0;
  const double share = std::clamp((light + soft) / (white + soft), 0.0, 1.0);
  return static_cast<std::uint8_t>(1 + std::lround(254 * std::sqrt(share)));
}

}  // namespace omma
