// Runs are joined to blobs as a flood fill would join the pixels.
#include "components/extractor/blob_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace omma {
namespace {

constexpr int kWidth = 40, kHeight = 30;
using Picture = std::vector<std::vector<bool>>;

// Area and box of every blob.
std::multiset<std::vector<int>> by_flood_fill(Picture picture) {
  std::multiset<std::vector<int>> blobs;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (!picture[v][u]) continue;
      std::vector<int> blob{0, u, u, v, v};
      std::vector<std::pair<int, int>> open{{u, v}};
      picture[v][u] = false;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        blob = {blob[0] + 1, std::min(blob[1], x), std::max(blob[2], x), std::min(blob[3], y),
                std::max(blob[4], y)};
        for (int b = std::max(0, y - 1); b <= std::min(kHeight - 1, y + 1); ++b) {
          for (int a = std::max(0, x - 1); a <= std::min(kWidth - 1, x + 1); ++a) {
            if (!picture[b][a]) continue;
            picture[b][a] = false;
            open.emplace_back(a, b);
          }
        }
      }
      blobs.insert(blob);
    }
  }
  return blobs;
}

std::multiset<std::vector<int>> by_runs(const Picture& picture) {
  std::multiset<std::vector<int>> blobs;
  BlobFinder finder(kWidth);
  const std::vector<std::uint8_t> ones(kWidth, 1);
  const auto sink = [&](const Blob& b) { blobs.insert({b.area, b.left, b.right, b.top, b.bottom}); };
  finder.start();
  for (int v = 0; v < kHeight; ++v) {
    finder.begin_row();
    for (int u = 0; u < kWidth; ++u) {
      if (!picture[v][u]) continue;
      int last = u;
      while (last + 1 < kWidth && picture[v][last + 1]) ++last;
      Blob& blob = finder.add_run(u, last, v);
      blob.add_row(ones.data(), u, last, v, 255, false);
      u = last;
    }
    finder.end_row(v, sink);
  }
  finder.finish(sink);
  return blobs;
}

TEST(BlobFinder, FindsWhatAFloodFillFindsAtEveryDensity) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    Picture picture(kHeight, std::vector<bool>(kWidth));
    const unsigned density = 5 + static_cast<unsigned>(trial) % 90;
    for (auto& row : picture)
      for (auto&& pixel : row) pixel = random() % 100 < density;
    ASSERT_EQ(by_runs(picture), by_flood_fill(picture)) << "trial " << trial;
  }
}

}  // namespace
}  // namespace omma
