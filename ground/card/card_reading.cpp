#include "ground/card/card_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr int kLeastArea = 20;       // [px]
constexpr double kRoundness = 0.12;  // of a disc's part of its box from π/4
constexpr double kLargestAspect = 1.25;
constexpr double kLikeTheOthers = 1.6;  // in diameter

// Grey levels as 256 steps, whatever the picture's depth.
class Levels {
 public:
  explicit Levels(const ImageView& image) : image_(image) {}
  double at(int u, int v) const {
    return image_.format == PixelFormat::kGrey8
               ? image_.row<std::uint8_t>(v)[u]
               : image_.row<std::uint16_t>(v)[u] * 255.0 / image_.white_level;
  }

 private:
  const ImageView& image_;
};

// Otsu 1979, IEEE Trans. SMC 9, 62: the level that parts the histogram into two with the least spread within.
double threshold_of(const ImageView& image) {
  std::array<double, 256> histogram{};
  const Levels levels(image);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u)
      histogram[static_cast<std::size_t>(std::clamp(levels.at(u, v), 0.0, 255.0))] += 1;
  }
  double total = 0;
  double sum = 0;
  for (std::size_t k = 0; k < 256; ++k) {
    total += histogram[k];
    sum += double(k) * histogram[k];
  }
  double below = 0;
  double sum_below = 0;
  double best = -1;
  double threshold = 128;
  for (std::size_t k = 0; k < 255; ++k) {
    below += histogram[k];
    sum_below += double(k) * histogram[k];
    if (below == 0 || below == total) continue;
    const double apart = sum_below / below - (sum - sum_below) / (total - below);
    const double between = below * (total - below) * apart * apart;
    if (between <= best) continue;
    best = between;
    threshold = double(k) + 0.5;
  }
  return threshold;
}

struct Blob {
  int area = 0;
  int left = 0, right = 0, top = 0, bottom = 0;
  bool at_border = false;
  bool light = false;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
};

// Connected runs of one side of the threshold, by flooding.
class Blobs {
 public:
  Blobs(const ImageView& image, double threshold)
      : image_(image),
        levels_(image),
        threshold_(threshold),
        seen_(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 0) {}

  std::vector<Blob> all() {
    std::vector<Blob> blobs;
    for (int v = 0; v < image_.height; ++v) {
      for (int u = 0; u < image_.width; ++u) {
        if (seen_[index(u, v)] == 0) blobs.push_back(flood(u, v));
      }
    }
    return blobs;
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(u);
  }
  bool light(int u, int v) const { return levels_.at(u, v) > threshold_; }

  Blob flood(int u0, int v0) {
    Blob blob;
    blob.light = light(u0, v0);
    blob.left = blob.right = u0;
    blob.top = blob.bottom = v0;
    std::vector<std::pair<int, int>> open{{u0, v0}};
    seen_[index(u0, v0)] = 1;
    while (!open.empty()) {
      const auto [u, v] = open.back();
      open.pop_back();
      ++blob.area;
      blob.left = std::min(blob.left, u);
      blob.right = std::max(blob.right, u);
      blob.top = std::min(blob.top, v);
      blob.bottom = std::max(blob.bottom, v);
      for (const auto& [x, y] :
           {std::pair{u - 1, v}, std::pair{u + 1, v}, std::pair{u, v - 1}, std::pair{u, v + 1}}) {
        if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) {
          blob.at_border = true;
        } else if (seen_[index(x, y)] == 0 && light(x, y) == blob.light) {
          seen_[index(x, y)] = 1;
          open.emplace_back(x, y);
        }
      }
    }
    return blob;
  }

  const ImageView& image_;
  Levels levels_;
  double threshold_;
  std::vector<std::uint8_t> seen_;
};

bool is_disc(const Blob& blob) {
  if (blob.at_border || blob.area < kLeastArea) return false;
  const double width = blob.right - blob.left + 1;
  const double height = blob.bottom - blob.top + 1;
  return std::max(width, height) <= kLargestAspect * std::min(width, height) + 1 &&
         std::abs(blob.area / (width * height) - std::numbers::pi / 4) < kRoundness;
}

// Grey-level centroid over the disc and two pixels about it: the edge pixels count by how much of them is
// covered.
Eigen::Vector2d centroid(const ImageView& image, const Blob& blob) {
  const Levels levels(image);
  const int left = std::max(0, blob.left - 2);
  const int right = std::min(image.width - 1, blob.right + 2);
  const int top = std::max(0, blob.top - 2);
  const int bottom = std::min(image.height - 1, blob.bottom + 2);
  double ground = 0;
  int count = 0;
  for (int u = left; u <= right; ++u) {
    ground += levels.at(u, top) + levels.at(u, bottom);
    count += 2;
  }
  ground /= count;
  double sum = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const double weight = std::max(0.0, blob.light ? levels.at(u, v) - ground : ground - levels.at(u, v));
      sum += weight;
      moment += weight * Eigen::Vector2d(u, v);
    }
  }
  return sum > 0 ? Eigen::Vector2d(moment / sum)
                 : Eigen::Vector2d(0.5 * (left + right), 0.5 * (top + bottom));
}

double diameter(const Blob& blob) {
  return 2 * std::sqrt(blob.area / std::numbers::pi);
}

double median_diameter(const std::vector<Blob>& discs) {
  std::vector<double> all;
  all.reserve(discs.size());
  for (const Blob& disc : discs) all.push_back(diameter(disc));
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

// Rows from the top, each from the left; discs whose heights differ by less than their size are of one row.
void put_in_order(std::vector<Blob>& discs, double size) {
  std::sort(discs.begin(), discs.end(),
            [](const Blob& a, const Blob& b) { return a.centre.y() < b.centre.y(); });
  for (auto first = discs.begin(); first != discs.end();) {
    auto last = first + 1;
    while (last != discs.end() && last->centre.y() - (last - 1)->centre.y() < 0.5 * size) ++last;
    std::sort(first, last, [](const Blob& a, const Blob& b) { return a.centre.x() < b.centre.x(); });
    first = last;
  }
}

std::vector<Blob> discs_of(const ImageView& image, int& passed_over) {
  std::vector<Blob> discs;
  int blobs = 0;
  for (const Blob& blob : Blobs(image, threshold_of(image)).all()) {
    if (blob.area >= kLeastArea && !blob.at_border) ++blobs;
    if (is_disc(blob)) discs.push_back(blob);
  }
  if (!discs.empty()) {
    const double size = median_diameter(discs);
    const auto lights = std::count_if(discs.begin(), discs.end(), [](const Blob& d) { return d.light; });
    const bool light = 2 * static_cast<std::size_t>(lights) > discs.size();
    std::erase_if(discs, [&](const Blob& d) {
      return d.light != light || diameter(d) > kLikeTheOthers * size || diameter(d) * kLikeTheOthers < size;
    });
  }
  passed_over = blobs - static_cast<int>(discs.size());
  return discs;
}

}  // namespace

CardReading read_card(const ImageView& image, double millimetres_per_pixel, const std::string& file) {
  CardReading reading;
  std::vector<Blob> discs = discs_of(image, reading.passed_over);
  if (discs.size() < 4)
    throw InputError(file, 0, "card", "at least four round discs", std::to_string(discs.size()));
  if (discs.size() > limits::kTargetsPerBody) {
    throw InputError(
        file, 0, "card",
        "at most " + std::to_string(limits::kTargetsPerBody) + " discs (limits::kTargetsPerBody)",
        std::to_string(discs.size()));
  }
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = -low;
  for (Blob& disc : discs) {
    disc.centre = centroid(image, disc);
    low = low.cwiseMin(disc.centre);
    high = high.cwiseMax(disc.centre);
  }
  const double size = median_diameter(discs);
  put_in_order(discs, size);
  reading.disc_mm = size * millimetres_per_pixel;
  const Eigen::Vector2d middle = 0.5 * (low + high);
  int number = 0;
  for (const Blob& disc : discs) {
    Target target;
    target.id = Name(format("T%02d", ++number));
    const Eigen::Vector2d from_middle = 1e-3 * millimetres_per_pixel * (disc.centre - middle);
    target.position = {from_middle.x(), -from_middle.y(), 0};
    target.group = 1;
    target.type = disc.light ? 1 : 0;
    reading.body.targets.push_back(target);
  }
  return reading;
}

std::string target_file_text(const TargetBody& body) {
  std::string text = "id\tx\ty\tz\tgroup\ttype\n";
  for (const Target& t : body.targets) {
    text += t.id.c_str();
    text += format("\t%.6f\t%.6f\t%.6f\t%d\t%d\n", t.position.x(), t.position.y(), t.position.z(), t.group,
                   t.type);
  }
  return text;
}

}  // namespace omma::ground
