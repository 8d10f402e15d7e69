// The image operations that the classical extraction pipelines are made of. Values in, values out; outside
// the image its border is repeated.
#pragma once

#include "ground/dots/grey_image.hpp"

namespace omma::ground {

/// max · (x / max)^power, negative values as 0: lifts what is dim where power < 1.
GreyImage power_look_up(const GreyImage& image, double power);
/// 1 where the pixel is brighter than the mean of the window about it by `deviations` of its standard
/// deviation (Niblack 1986), else 0. @param window  side [px], odd
GreyImage local_threshold(const GreyImage& image, int window, double deviations);
/// Median over a square window. @param window  side [px], odd
GreyImage median_filter(const GreyImage& image, int window);
/// Without its low spatial frequencies: those below `part` of the highest along both axes (Fourier transform,
/// the mean included).
GreyImage remove_low_frequencies(const GreyImage& image, double part);
/// Smoothed by a Gaussian. @param sigma  [px]
GreyImage gaussian_smooth(const GreyImage& image, double sigma);
/// Magnitude of the Sobel gradient.
GreyImage sobel(const GreyImage& image);
/// 3×3 kernel that adds each pixel's difference from its eight neighbours; negative results as 0.
GreyImage highlight_details(const GreyImage& image);
/// Largest value of the 3×3 neighbourhood.
GreyImage dilate(const GreyImage& image);
/// Dilated, then eroded: fills what is narrower than three pixels.
GreyImage close(const GreyImage& image);
GreyImage subtract(const GreyImage& image, const GreyImage& other);
/// The image where the mask is not 0, elsewhere 0.
GreyImage masked(const GreyImage& image, const GreyImage& mask);

}  // namespace omma::ground
