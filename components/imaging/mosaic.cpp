#include "components/imaging/mosaic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omma {
namespace {

constexpr int kLargestBox = 15;  // [px] bounds the work of one output pixel

template <class Pixel>
double interpolated(const ImageView& image, double u, double v) {
  const double x = std::clamp(u, 0.0, image.width - 1.0);
  const double y = std::clamp(v, 0.0, image.height - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(image.width - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(image.height - 2, 0));
  const int right = std::min(column + 1, image.width - 1);
  const Pixel* top = image.row<Pixel>(row);
  const Pixel* bottom = image.row<Pixel>(std::min(row + 1, image.height - 1));
  const double a = x - column;
  const double b = y - row;
  return (1 - b) * ((1 - a) * top[column] + a * top[right]) +
         b * ((1 - a) * bottom[column] + a * bottom[right]);
}

template <class Pixel>
double over_box(const ImageView& image, double u, double v, int box, Footprint footprint) {
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
      sum += pixels[column];
      peak = std::max<int>(peak, pixels[column]);
      ++count;
    }
  }
  if (count == 0) return interpolated<Pixel>(image, u, v);
  return footprint == Footprint::kMean ? sum / count : peak;
}

template <class Pixel>
double grey(const ImageView& image, const SeenPixel& seen, int box, Footprint footprint) {
  return box <= 1 ? interpolated<Pixel>(image, seen.u, seen.v)
                  : over_box<Pixel>(image, seen.u, seen.v, box, footprint);
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
    if (image.empty() || image.width != table_.width(camera) || image.height != table_.height(camera))
      continue;
    const double level = image.format == PixelFormat::kGrey8
                             ? grey<std::uint8_t>(image, seen[camera], boxes[camera], footprint_)
                             : grey<std::uint16_t>(image, seen[camera], boxes[camera], footprint_);
    const double share = level / image.white_level;
    const double value = share - levels_[camera].black;
    weighted += seen[camera].weight * levels_[camera].gain * value;
    weights += seen[camera].weight;
    if (sums == nullptr || share >= 1) continue;  // a full pixel says nothing about its gain
    if (last >= 0) sums->add(last, last_value, camera, value);
    last = camera;
    last_value = value;
  }
  return weights > 0 ? weighted / weights : std::numeric_limits<double>::quiet_NaN();
}

std::uint8_t companded(double light, double white) noexcept {
  if (std::isnan(light)) return 0;
  const double share = std::clamp(light / white, 0.0, 1.0);
  return static_cast<std::uint8_t>(1 + std::lround(254 * std::sqrt(share)));
}

}  // namespace omma
