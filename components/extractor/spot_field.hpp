// The spots of one image as each other's neighbours: who is near whom, and whose light falls into a window.
#pragma once

#include <cstddef>
#include <vector>

#include "components/extractor/spot_fit.hpp"

namespace omma {

/// A point of light as its neighbours see it.
struct FieldSpot {
  float u = 0, v = 0;  ///< [px]
  float sigma = 1;     ///< [px]
  float flux = 0;      ///< [grey levels]; 0: there is none after all
};

class SpotField {
 public:
  static constexpr int kCell = 32;  ///< side of a cell [px]; no spot's light reaches further

  /// Allocates for images of at most this size and so many spots; nothing is allocated later.
  SpotField(int width, int height, std::size_t spots);

  void clear() noexcept;
  /// @return its number; there must be room
  std::size_t add(const FieldSpot& spot) noexcept;
  void set(std::size_t i, const FieldSpot& spot) noexcept;
  const FieldSpot& operator[](std::size_t i) const noexcept { return spots_[i]; }
  std::size_t size() const noexcept { return spots_.size(); }

  /// Takes the light of all spots but number `self` out of the window, and trusts the pixels less where it
  /// was.
  /// @param noise  standard deviation of a pixel [grey levels]
  /// @return whether there was any to speak of
  bool take_away(std::size_t self, float noise, SpotWindow& window) const noexcept;
  /// Whether no other spot's light reaches within `radius` of spot number `self`.
  bool is_alone(std::size_t self, int radius) const noexcept;
  /// Whether none but spot number `self` was added within `distance` of it on both axes, light or not.
  bool is_lone(std::size_t self, float distance) const noexcept;
  /// Of two spots added so far from each other on an axis, whether none has light within `radius` of the
  /// other.
  bool is_far(float distance, int radius) const noexcept {
    return distance >= static_cast<float>(radius) + 1 + largest_reach_ + 2 * largest_move_;
  }
  /// Whether another spot than number `self` is so near that the two cannot be told apart.
  bool has_twin(std::size_t self, float u, float v) const noexcept;

 private:
  template <class Visit>
  void for_added(float u, float v, float distance, Visit&& visit) const noexcept;
  template <class Visit>
  void for_near(float u, float v, float distance, Visit&& visit) const noexcept;

  int columns_, rows_;
  struct Home {
    float u, v;  // where it was added: it stays in that cell [px]
    int next;    // in the same cell; −1: none
  };

  std::vector<int> first_;  // of each cell
  std::vector<FieldSpot> spots_;
  std::vector<Home> homes_;
  float largest_reach_ = 0;  // of any spot's light [px]
  float largest_move_ = 0;   // of any spot from its home, on either axis [px]
};

}  // namespace omma
