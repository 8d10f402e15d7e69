// The three extraction pipelines of Miller's dissertation, stage by stage, for comparison and for odd
// imagery. Source: J. Miller, algorithms 4 (MLAS), 5 (small target) and 7 (stars). What the text leaves open
// (windows, factors, sizes) is a parameter here; docs/algorithms/classical_extraction.md says what was
// chosen. All memory is made at construction.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "components/extractor/classical/binary_objects.hpp"
#include "components/extractor/classical/classical_parameters.hpp"
#include "components/extractor/classical/filters.hpp"
#include "components/extractor/classical/local_threshold.hpp"
#include "components/extractor/classical/low_frequencies.hpp"

namespace omma {

/// An object of a pipeline's last binary image.
struct ClassicalDot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();    ///< centre of mass of its pixels [px]
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();  ///< of its pixels [px²]
  int left = 0, right = 0, top = 0, bottom = 0;       ///< bounding box, inclusive [px]
  int area = 0;                                       ///< [px]
  float light = 0;  ///< sum of the original image's grey levels over its pixels, background included
  float peak = 0;   ///< the largest of them
};

/// Called with each stage's name and image, in order.
using StageObserver = std::function<void(std::string_view name, const GreyImage& image)>;

class ClassicalPipelines {
 public:
  static constexpr std::size_t kMost = 4096;  ///< dots of an image; beyond, those of least light are dropped

  /// For images of exactly this size, 3 × 3 at least.
  ClassicalPipelines(int width, int height, const ClassicalParameters& parameters);

  /// The image that the next run works on: to be filled in; a run does not change it.
  GreyImage& original() { return original_; }
  const GreyImage& original() const { return original_; }
  /// @param observer  null: nobody looks on
  /// @return in reading order, unless some were dropped; valid until the next run
  std::span<const ClassicalDot> run(ClassicalAlgorithm algorithm,
                                    const StageObserver* observer = nullptr) noexcept;
  std::uint32_t dropped() const { return dropped_; }  ///< in the last run

  const ClassicalParameters& parameters() const { return parameters_; }

 private:
  void mlas() noexcept;
  void small_target() noexcept;
  void stars() noexcept;
  void show(std::string_view name, const GreyImage& image) const noexcept;
  void threshold(const GreyImage& image) noexcept;
  void take_dots() noexcept;
  void drop_faint_half() noexcept;

  ClassicalParameters parameters_;
  GreyImage original_, filtered_, work_, binary_;
  RowRing ring_;
  LocalThreshold local_;
  LowFrequencies low_frequencies_;
  ObjectFinder objects_;
  std::vector<ClassicalDot> dots_;
  std::uint32_t dropped_ = 0;
  const StageObserver* observer_ = nullptr;  // while run runs
};

}  // namespace omma
