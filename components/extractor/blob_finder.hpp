// Connected components in one pass over the rows: runs of set bits are joined to the runs they touch in
// the row above (8-connected) with union-find; a blob that gains no run in a row is finished and handed
// over, so memory is bounded by the width of the image whatever the image shows.
// Source: run-based labelling, He, Chao & Suzuki 2008, IEEE Trans. Image Process. 17(5), 749.
#pragma once

#include <cstdint>
#include <vector>

namespace omma {

/// Sums over the pixels of a blob about its origin pixel, of one weight.
struct PixelSums {
  std::int64_t n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
  void add(std::int64_t weight, std::int64_t du, std::int64_t dv) {
    n += weight;
    u += weight * du;
    v += weight * dv;
    uu += weight * du * du;
    uv += weight * du * dv;
    vv += weight * dv * dv;
  }
  void operator+=(const PixelSums& other) {
    n += other.n;
    u += other.u;
    v += other.v;
    uu += other.uu;
    uv += other.uv;
    vv += other.vv;
  }
  /// The same sums about an origin moved by (−du, −dv): every pixel's offset grows by (du, dv).
  PixelSums moved(std::int64_t du, std::int64_t dv) const {
    return {n,
            u + du * n,
            v + dv * n,
            uu + 2 * du * u + du * du * n,
            uv + du * v + dv * u + du * dv * n,
            vv + 2 * dv * v + dv * dv * n};
  }
};

/// A connected set of pixels over the detection threshold.
struct Blob {
  int origin_u = 0, origin_v = 0;                ///< its first pixel in reading order; the sums are about it
  int left = 0, right = 0, top = 0, bottom = 0;  ///< bounding box, inclusive [px]
  int peak = 0;                                  ///< largest smoothed value
  int peak_u = 0, peak_v = 0;                    ///< where
  PixelSums shape;                               ///< weight 1
  PixelSums light;                               ///< weight: grey level, background included
  PixelSums saturated;                           ///< weight 1 on pixels at the white level
  std::int64_t light_squared = 0;                ///< sum of squared grey levels

  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
  void merge(const Blob& other);
};

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
