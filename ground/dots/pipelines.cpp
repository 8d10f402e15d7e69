#include "ground/dots/pipelines.hpp"

#include "ground/dots/filters.hpp"
#include "ground/dots/objects.hpp"

namespace omma::ground {
namespace {

// Passes each stage's image to the observer and on.
class Stages {
 public:
  explicit Stages(const StageObserver& observer) : observer_(observer) {}
  GreyImage operator()(std::string_view name, GreyImage image) const {
    if (observer_) observer_(name, image);
    return image;
  }

 private:
  const StageObserver& observer_;
};

std::vector<ClassicalDot> centroids(const std::vector<BinaryObject>& found) {
  std::vector<ClassicalDot> dots;
  dots.reserve(found.size());
  for (const BinaryObject& object : found) dots.push_back({object.centre, static_cast<int>(object.area())});
  return dots;
}

auto inside(const GreyImage& image) {
  return [&image](const BinaryObject& object) { return !object.at_edge(image); };
}
auto elliptic(const ClassicalParameters& p) {
  return [&p](const BinaryObject& object) {
    return object.ellipticity() >= p.least_ellipticity && object.elongation() <= 2 * p.largest_elongation;
  };
}
auto circular(const ClassicalParameters& p) {
  return [&p](const BinaryObject& object) {
    return object.ellipticity() >= p.least_ellipticity && object.elongation() <= p.largest_elongation;
  };
}

}  // namespace

std::vector<ClassicalDot> mlas_dots(const GreyImage& image, const ClassicalParameters& p,
                                    const StageObserver& observer) {
  const Stages stage(observer);
  stage("original", image);
  const GreyImage equalised = stage("square-root equalised", power_look_up(image, 0.5));
  GreyImage binary = stage("local threshold", local_threshold(equalised, p.window, p.deviations));
  std::vector<BinaryObject> found = objects(binary);
  keep(binary, found, inside(binary));
  stage("without edge objects", binary);
  keep(binary, found, [&](const BinaryObject& o) { return o.area() >= p.least_area; });
  stage("without small objects", binary);
  keep(binary, found, [&](const BinaryObject& o) { return o.compactness() >= p.least_compactness; });
  stage("compact objects", binary);
  keep(binary, found, elliptic(p));
  stage("ellipses", binary);
  keep(binary, found, [](const BinaryObject& o) { return o.holes == 0; });
  stage("without holes", binary);
  const GreyImage mask = stage("dilated mask", dilate(binary));
  const GreyImage dots_only = stage("masked original", masked(image, mask));
  const GreyImage sharp = stage("median filtered", median_filter(dots_only, 3));
  const GreyImage final = stage("local threshold again", local_threshold(sharp, p.window, p.deviations));
  return centroids(objects(final));
}

std::vector<ClassicalDot> small_target_dots(const GreyImage& image, const ClassicalParameters& p,
                                            const StageObserver& observer) {
  const Stages stage(observer);
  stage("luminance", image);
  const GreyImage filtered =
      stage("without low frequencies", remove_low_frequencies(image, p.low_frequencies));
  const GreyImage equalised = stage("square-root equalised", power_look_up(filtered, 0.5));
  GreyImage binary = stage("local threshold", local_threshold(equalised, p.window, p.deviations));
  std::vector<BinaryObject> found = objects(binary);
  keep(binary, found, inside(binary));
  stage("without edge objects", binary);
  keep(binary, found, [&](const BinaryObject& o) { return o.area() >= p.least_area && elliptic(p)(o); });
  stage("ellipses", binary);
  const GreyImage mask = stage("dilated mask", dilate(binary));
  const GreyImage dots_only = stage("masked image", masked(filtered, mask));
  const GreyImage smooth = stage("Gaussian smoothed", gaussian_smooth(dots_only, p.smooth));
  const GreyImage final = stage("local threshold again", local_threshold(smooth, p.window, p.deviations));
  return centroids(objects(final));
}

std::vector<ClassicalDot> star_dots(const GreyImage& image, const GreyImage& black_frame,
                                    const ClassicalParameters& p, const StageObserver& observer) {
  const Stages stage(observer);
  const GreyImage original =
      stage("original less black frame", black_frame.value.empty() ? image : subtract(image, black_frame));
  const GreyImage background = stage("median background", median_filter(original, p.background_window));
  const GreyImage clean = stage("less background", subtract(original, background));
  const GreyImage detail = stage("without the lowest 60 %", remove_low_frequencies(clean, 0.6));
  const GreyImage edges = stage("Sobel edges", sobel(detail));
  const GreyImage filled = stage("closed", close(edges));
  const GreyImage bright_edges = stage("details highlighted", highlight_details(filled));
  const GreyImage bright = stage("closed again", close(bright_edges));
  const GreyImage even = stage("Gaussian smoothed", gaussian_smooth(bright, p.smooth));
  const GreyImage discs = stage("look-up x^0.8", power_look_up(even, 0.8));
  const GreyImage large = stage("dilated", dilate(discs));
  GreyImage binary = stage("local threshold", local_threshold(large, p.window, p.deviations));
  std::vector<BinaryObject> found = objects(binary);
  keep(binary, found, [&](const BinaryObject& o) { return !o.at_edge(binary) && circular(p)(o); });
  const GreyImage mask = stage("mask of circles", binary);
  const GreyImage flat = stage("original without the lowest 5 %", remove_low_frequencies(original, 0.05));
  const GreyImage stars = stage("masked", masked(flat, mask));
  const GreyImage smooth = stage("Gaussian smoothed again", gaussian_smooth(stars, p.smooth));
  const GreyImage lifted = stage("look-up x^0.5", power_look_up(smooth, 0.5));
  GreyImage final = local_threshold(lifted, p.window, p.deviations);
  std::vector<BinaryObject> last = objects(final);
  keep(final, last, [&](const BinaryObject& o) { return o.area() <= p.largest_area; });
  stage("local threshold again, without large objects", final);
  return centroids(last);
}

}  // namespace omma::ground
