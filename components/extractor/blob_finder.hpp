// Connected components in one pass over the rows: runs of set bits are joined to the runs they touch in
// the row above (8-connected) with union-find; a blob that gains no run in a row is finished and handed
// over, so memory is bounded by the width of the image whatever the image shows.
// Source: run-based labelling, He, Chao & Suzuki 2008, IEEE Trans. Image Process. 17(5), 749.
#pragma once

#include <cstdint>
#include <vector>

namespace omma {

/// A connected set of pixels over the detection threshold.
struct Blob {
  int origin_u = 0, origin_v = 0;                ///< its first pixel in reading order; the sums are about it
  int left = 0, right = 0, top = 0, bottom = 0;  ///< bounding box, inclusive [px]
  int area = 0;                                  ///< pixels
  int saturated = 0;                             ///< of them at the white level
  int peak = 0;                                  ///< largest grey level
  std::int64_t sum_u = 0, sum_v = 0;             ///< of the pixels' places about the origin
  std::int64_t light = 0;                        ///< sum of grey levels, background included
  std::int64_t light_u = 0, light_v = 0;         ///< the same times the place about the origin

  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
  /// The pixels first … last of row v, `x` being the row; dark dots are turned into bright ones.
  template <class Pixel>
  void add_row(const Pixel* x, int first, int last, int v, int white, bool invert);
  void merge(const Blob& other);
};

template <class Pixel>
void Blob::add_row(const Pixel* x, int first, int last, int v, int white, bool invert) {
  std::int64_t row_light = 0, row_light_u = 0;  // about the run's first pixel
  for (int u = first; u <= last; ++u) {
    const int grey = invert ? white - x[u] : x[u];
    row_light += grey;
    row_light_u += std::int64_t{grey} * (u - first);
    peak = grey > peak ? grey : peak;
    saturated += grey >= white ? 1 : 0;
  }
  const std::int64_t pixels = last - first + 1;
  const std::int64_t du = first - origin_u;
  const std::int64_t dv = v - origin_v;
  area += static_cast<int>(pixels);
  sum_u += du * pixels + pixels * (pixels - 1) / 2;
  sum_v += dv * pixels;
  light += row_light;
  light_u += row_light_u + du * row_light;
  light_v += dv * row_light;
}

/// Streams rows of runs into finished blobs. `Sink` is called with each finished blob.
class BlobFinder {
 public:
  explicit BlobFinder(int width);

  void start() noexcept;
  /// Begins row v; runs are then added from left to right.
  void begin_row() noexcept { current_.clear(); }
  /// Adds the run [first, last] to the row.
  /// @return the blob it belongs to, to add its pixels to
  Blob& add_run(int first, int last, int v) noexcept;
  /// Ends row v and hands over the blobs that ended above it.
  template <class Sink>
  void end_row(int v, Sink&& sink) noexcept;
  /// Hands over what is left.
  template <class Sink>
  void finish(Sink&& sink) noexcept;
  bool idle() const { return active_.empty(); }

 private:
  struct Run {
    int first, last, blob;
  };
  struct Node {
    Blob blob;
    int parent = -1;  // −1: a root
    int last_row = 0;
  };
  int find(int i) const noexcept {
    while (nodes_[static_cast<std::size_t>(i)].parent >= 0) i = nodes_[static_cast<std::size_t>(i)].parent;
    return i;
  }

  std::vector<Run> previous_, current_;  // capacity fixed at construction
  std::vector<Node> nodes_;
  std::vector<int> free_, active_;
  std::size_t scan_ = 0;  // first run of the row above that can still touch
};

template <class Sink>
void BlobFinder::end_row(int v, Sink&& sink) noexcept {
  for (Run& run : current_) run.blob = find(run.blob);
  std::size_t kept = 0;
  for (const int i : active_) {
    Node& node = nodes_[static_cast<std::size_t>(i)];
    if (node.parent >= 0 || node.last_row < v) {
      if (node.parent < 0) sink(node.blob);
      free_.push_back(i);
    } else {
      active_[kept++] = i;
    }
  }
  active_.resize(kept);
  previous_.swap(current_);
  scan_ = 0;
}

template <class Sink>
void BlobFinder::finish(Sink&& sink) noexcept {
  for (const int i : active_) {
    if (nodes_[static_cast<std::size_t>(i)].parent < 0) sink(nodes_[static_cast<std::size_t>(i)].blob);
  }
  start();
}

}  // namespace omma
