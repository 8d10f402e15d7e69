#include "components/extractor/classical/pipelines.hpp"

#include <algorithm>

namespace omma {
namespace {

auto inside(const GreyImage& image) {
  return [&image](const BinaryObject& object) { return !object.at_edge(image); };
}
bool is_elliptic(const BinaryObject& object, const ClassicalParameters& p) {
  return object.ellipticity() >= p.least_ellipticity && object.elongation() <= 2 * p.largest_elongation;
}
bool is_circular(const BinaryObject& object, const ClassicalParameters& p) {
  return object.ellipticity() >= p.least_ellipticity && object.elongation() <= p.largest_elongation;
}

}  // namespace

ClassicalPipelines::ClassicalPipelines(int width, int height, const ClassicalParameters& parameters)
    : parameters_(parameters),
      original_(width, height),
      filtered_(width, height),
      work_(width, height),
      binary_(width, height),
      ring_(width, std::max({1, parameters.background_window / 2, gaussian_reach(parameters.smooth)})),
      local_(width),
      low_frequencies_(width, height),
      objects_(width, height) {
  dots_.reserve(kMost);
}

std::span<const ClassicalDot> ClassicalPipelines::run(ClassicalAlgorithm algorithm,
                                                      const StageObserver* observer) noexcept {
  observer_ = observer;
  dots_.clear();
  dropped_ = 0;
  std::copy(original_.value.begin(), original_.value.end(), work_.value.begin());
  switch (algorithm) {
    case ClassicalAlgorithm::kMlas:
      mlas();
      break;
    case ClassicalAlgorithm::kSmallTarget:
      small_target();
      break;
    case ClassicalAlgorithm::kStars:
      stars();
      break;
  }
  take_dots();
  observer_ = nullptr;
  return dots_;
}

void ClassicalPipelines::mlas() noexcept {
  const ClassicalParameters& p = parameters_;
  show("original", work_);
  square_root_look_up(work_);
  show("square-root equalised", work_);
  threshold(work_);
  show("local threshold", binary_);
  objects_.keep(binary_, inside(binary_));
  show("without edge objects", binary_);
  objects_.keep(binary_, [&](const BinaryObject& o) { return o.area() >= p.least_area; });
  show("without small objects", binary_);
  objects_.keep(binary_, [&](const BinaryObject& o) { return o.compactness() >= p.least_compactness; });
  show("compact objects", binary_);
  objects_.keep(binary_, [&](const BinaryObject& o) { return is_elliptic(o, p); });
  show("ellipses", binary_);
  objects_.keep(binary_, [](const BinaryObject& o) { return o.holes == 0; });
  show("without holes", binary_);
  dilate(binary_, ring_);
  show("dilated mask", binary_);
  std::copy(original_.value.begin(), original_.value.end(), work_.value.begin());
  leave_masked(binary_, work_);
  show("masked original", work_);
  median_filter(work_, 3, ring_);
  show("median filtered", work_);
  threshold(work_);
  show("local threshold again", binary_);
}

void ClassicalPipelines::small_target() noexcept {
  const ClassicalParameters& p = parameters_;
  show("luminance", work_);
  low_frequencies_.remove(work_, p.low_frequencies);
  std::copy(work_.value.begin(), work_.value.end(), filtered_.value.begin());
  show("without low frequencies", work_);
  square_root_look_up(work_);
  show("square-root equalised", work_);
  threshold(work_);
  show("local threshold", binary_);
  objects_.keep(binary_, inside(binary_));
  show("without edge objects", binary_);
  objects_.keep(binary_,
                [&](const BinaryObject& o) { return o.area() >= p.least_area && is_elliptic(o, p); });
  show("ellipses", binary_);
  dilate(binary_, ring_);
  show("dilated mask", binary_);
  std::copy(filtered_.value.begin(), filtered_.value.end(), work_.value.begin());
  leave_masked(binary_, work_);
  show("masked image", work_);
  gaussian_smooth(work_, p.smooth, ring_);
  show("Gaussian smoothed", work_);
  threshold(work_);
  show("local threshold again", binary_);
}

void ClassicalPipelines::stars() noexcept {
  const ClassicalParameters& p = parameters_;
  show("original less black frame", work_);
  median_filter(work_, p.background_window, ring_);
  show("median background", work_);
  for (std::size_t i = 0; i < work_.value.size(); ++i) work_.value[i] = original_.value[i] - work_.value[i];
  show("less background", work_);
  low_frequencies_.remove(work_, 0.6);
  show("without the lowest 60 %", work_);
  sobel(work_, ring_);
  show("Sobel edges", work_);
  close(work_, ring_);
  show("closed", work_);
  highlight_details(work_, ring_);
  show("details highlighted", work_);
  close(work_, ring_);
  show("closed again", work_);
  gaussian_smooth(work_, p.smooth, ring_);
  show("Gaussian smoothed", work_);
  four_fifths_look_up(work_);
  show("look-up x^0.8", work_);
  dilate(work_, ring_);
  show("dilated", work_);
  threshold(work_);
  show("local threshold", binary_);
  objects_.keep(binary_, [&](const BinaryObject& o) { return !o.at_edge(binary_) && is_circular(o, p); });
  show("mask of circles", binary_);
  std::copy(original_.value.begin(), original_.value.end(), work_.value.begin());
  low_frequencies_.remove(work_, 0.05);
  show("original without the lowest 5 %", work_);
  leave_masked(binary_, work_);
  show("masked", work_);
  gaussian_smooth(work_, p.smooth, ring_);
  show("Gaussian smoothed again", work_);
  square_root_look_up(work_);
  show("look-up x^0.5", work_);
  threshold(work_);
  objects_.keep(binary_, [&](const BinaryObject& o) { return o.area() <= p.largest_area; });
  show("local threshold again, without large objects", binary_);
}

void ClassicalPipelines::show(std::string_view name, const GreyImage& image) const noexcept {
  if (observer_ != nullptr && *observer_) (*observer_)(name, image);
}

void ClassicalPipelines::threshold(const GreyImage& image) noexcept {
  local_.apply(image, parameters_.window, parameters_.deviations, binary_);
}

void ClassicalPipelines::take_dots() noexcept {
  objects_.for_each(binary_, [&](const BinaryObject& object) {
    ClassicalDot dot;
    dot.pixel = object.centre;
    dot.moments = object.moments;
    dot.left = object.left;
    dot.right = object.right;
    dot.top = object.top;
    dot.bottom = object.bottom;
    dot.area = static_cast<int>(object.pixels.size());
    for (const std::uint32_t i : object.pixels) {
      dot.light += original_.value[i];
      dot.peak = std::max(dot.peak, original_.value[i]);
    }
    if (dots_.size() == kMost) drop_faint_half();
    dots_.push_back(dot);
  });
}

// What is bright must not be lost because it comes late.
void ClassicalPipelines::drop_faint_half() noexcept {
  const auto middle = dots_.begin() + static_cast<std::ptrdiff_t>(dots_.size() / 2);
  std::nth_element(dots_.begin(), middle, dots_.end(), [](const ClassicalDot& a, const ClassicalDot& b) {
    if (a.light != b.light) return a.light > b.light;
    return a.pixel.y() != b.pixel.y() ? a.pixel.y() < b.pixel.y() : a.pixel.x() < b.pixel.x();
  });
  dropped_ += static_cast<std::uint32_t>(dots_.end() - middle);
  dots_.erase(middle, dots_.end());
}

}  // namespace omma
