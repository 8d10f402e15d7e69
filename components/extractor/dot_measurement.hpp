// Measures the dots of one image on its grey levels, the brightest first: points of light by a least-squares
// fit of a Gaussian spot, with the light of their neighbours taken away; wide discs by their grey-level
// centroid. The width of the image's point spread is learnt from its brightest spots and steadies the faint
// ones. Formulas in docs/algorithms/extractor.md#measurement.
#pragma once

#include <cstdint>
#include <vector>

#include "components/extractor/candidate.hpp"
#include "components/extractor/dot.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "components/extractor/falling_order.hpp"
#include "components/extractor/fits_ahead.hpp"
#include "components/extractor/spot_field.hpp"
#include "components/extractor/spot_fit.hpp"
#include "components/extractor/trail_fit.hpp"
#include "hal/image.hpp"

namespace omma {

class DotMeasurement {
 public:
  /// For images of at most this size, and at most so many dots; nothing is allocated later.
  DotMeasurement(int width, int height, std::size_t dots);

  /// Takes an image and puts its candidates into order, brightest first.
  /// @param invert  the dots are darker than the background
  /// @param masks   outlive the measuring
  /// @return width of the image's point spread [px]; 0 where too few spots tell it
  float start(const ImageView& image, bool invert, const ExtractorParameters& parameters,
              const ImageMasks& masks, std::vector<Candidate>& candidates) noexcept;
  /// Measures the candidates last given to start, brightest first, and adds what is found to `dots`, up to
  /// twice what a list of dots holds and up to their capacity.
  /// @return how many candidates were left unmeasured
  std::size_t measure(const std::vector<Candidate>& candidates, std::vector<Dot>& dots) noexcept;

 private:
  void put_in_order(std::vector<Candidate>& candidates) noexcept;
  void learn_width(const std::vector<Candidate>& candidates) noexcept;
  Eigen::Matrix2d grown(const Eigen::Matrix2d& covariance, double chi2_per_pixel, float snr) const noexcept;
  double significant_chi2() const noexcept;
  double noise_share() const noexcept;
  bool try_trail(const Candidate& candidate, std::size_t self, Dot& dot) noexcept;
  bool may_be_point(const Candidate& candidate) const noexcept;
  bool measure_point(const Candidate& candidate, std::size_t self, Dot& dot) noexcept;
  bool judge_point(const Candidate& candidate, std::size_t self, const MiddleLight& light, Dot& dot) noexcept;
  bool is_near(const Candidate& candidate) const noexcept;
  MiddleLight middle_light() const noexcept;
  bool is_better_as_disc(const Candidate& candidate, const Dot& dot) const noexcept;
  bool measure_disc(const Candidate& candidate, Dot& dot) const noexcept;
  void start_at(const Candidate& candidate) noexcept;
  void start_at(const FieldSpot& spot) noexcept;
  FieldSpot fitted() const noexcept;
  bool fit_point(const Candidate& candidate, std::size_t self) noexcept;
  void load(double u, double v, int radius) noexcept;
  void set_narrowest(float sigma) noexcept;
  bool is_hot_pixel(const Candidate& candidate, const MiddleLight& light) const noexcept;
  bool remeasure_crowded(const std::vector<Candidate>& candidates, std::vector<Dot>& dots) noexcept;
  bool is_blind(const Eigen::Vector2d& pixel) const noexcept;
  void finish(const Candidate& candidate, Dot& dot) const noexcept;

  const ImageView* image_ = nullptr;  // while measure runs
  const ExtractorParameters* parameters_ = nullptr;
  bool invert_ = false;
  ImageMasks masks_;
  float background_ = 0;  // of the candidate at hand
  SpotWindow window_;
  SpotFit fit_;
  TrailFit trail_;
  bool crowded_ = false;  // light of a neighbour was in the window
  SpotPrior prior_;
  bool width_known_ = false;
  bool trails_ = false;      // most spots of the image are long
  double least_beside_ = 0;  // light of a neighbour over that of the brightest pixel, of the narrowest spot
  double residuals_ = 0, pixels_ = 0;  // χ² of the spots that are as the model says, and their pixels
  SpotField field_;                    // one spot a candidate
  std::vector<int> dot_of_spot_;       // −1: none
  FitsAhead ahead_;
  std::vector<std::uint8_t> lone_;  // 1: of a spot that was fitted ahead
  std::vector<float> widths_;
  std::vector<Ranked> ranking_, ranking_scratch_;
  std::vector<Candidate> unordered_;
};

}  // namespace omma
