// Connected components in one pass over the rows.
#include "components/extractor/blob_finder.hpp"

#include <algorithm>

#include "components/extractor/index.hpp"

namespace omma {

void Blob::merge(const Blob& other) {
  const std::int64_t du = other.origin_u - origin_u;
  const std::int64_t dv = other.origin_v - origin_v;
  left = std::min(left, other.left);
  right = std::max(right, other.right);
  top = std::min(top, other.top);
  bottom = std::max(bottom, other.bottom);
  area += other.area;
  saturated += other.saturated;
  peak = std::max(peak, other.peak);
  sum_u += other.sum_u + du * other.area;
  sum_v += other.sum_v + dv * other.area;
  light += other.light;
  light_u += other.light_u + du * other.light;
  light_v += other.light_v + dv * other.light;
}

BlobFinder::BlobFinder(int width) {
  // A row has at most (width + 1) / 2 runs; nodes live while a run of this row or the one above names them.
  const auto runs = index_of(width / 2 + 2);
  previous_.reserve(runs);
  current_.reserve(runs);
  nodes_.resize(2 * runs);
  free_.reserve(nodes_.size());
  active_.reserve(nodes_.size());
  start();
}

void BlobFinder::start() noexcept {
  previous_.clear();
  current_.clear();
  active_.clear();
  free_.clear();
  for (std::size_t i = nodes_.size(); i-- > 0;) free_.push_back(static_cast<int>(i));
  scan_ = 0;
}

Blob& BlobFinder::add_run(int first, int last, int v) noexcept {
  while (scan_ < previous_.size() && previous_[scan_].last < first - 1) ++scan_;
  int home = -1;
  for (std::size_t k = scan_; k < previous_.size() && previous_[k].first <= last + 1; ++k) {
    const int root = find(previous_[k].blob);
    if (home < 0) {
      home = root;
    } else if (root != home) {
      nodes_[static_cast<std::size_t>(home)].blob.merge(nodes_[static_cast<std::size_t>(root)].blob);
      nodes_[static_cast<std::size_t>(root)].parent = home;
    }
  }
  if (home < 0) {
    home = free_.back();
    free_.pop_back();
    active_.push_back(home);
    Node& node = nodes_[static_cast<std::size_t>(home)];
    node.parent = -1;
    node.blob = Blob{};
    node.blob.origin_u = first;
    node.blob.origin_v = v;
    node.blob.left = first;
    node.blob.right = last;
    node.blob.top = v;
  }
  Node& node = nodes_[static_cast<std::size_t>(home)];
  node.last_row = v;
  node.blob.left = std::min(node.blob.left, first);
  node.blob.right = std::max(node.blob.right, last);
  node.blob.bottom = v;
  current_.push_back({first, last, home});
  return node.blob;
}

}  // namespace omma
