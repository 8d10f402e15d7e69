// Candidate: a blob of pixels over the threshold on its way to being a dot.
#pragma once

namespace omma {

/// What is known of the pixels around a dot.
struct PixelNoise {
  float background = 0;  ///< local, dark dots already turned into bright ones [grey levels]
  float sigma = 1;       ///< standard deviation of a pixel of the background [grey levels]
  float gain = 0;        ///< electrons per grey level
  float relative = 0;    ///< noise that is this share of the light
};

struct Candidate {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< bounding box, inclusive [px]
  int area = 0;                                  ///< pixels over the threshold
  int saturated = 0;                             ///< of them full
  float u = 0, v = 0;                            ///< centroid of its light over the background [px]
  float top_u = 0, top_v = 0;                    ///< pixel where its smoothed light is highest
  float lean_u = 0, lean_v = 0;                  ///< of the light beside that pixel, as Peak's
  float peak = 0;                                ///< brightest pixel over the background [grey levels]
  float height = 0;     ///< its smoothed light where that is highest, over the background [grey levels]
  float threshold = 1;  ///< that the smoothed light was over [standard deviations of a pixel]
  int peaks = 1;        ///< of the blob that this is one of
  PixelNoise noise;
};

/// Order of brightness; ties in reading order, so that it is the same on every machine.
inline bool brighter(const Candidate& a, const Candidate& b) {
  if (a.height != b.height) return a.height > b.height;
  return a.v != b.v ? a.v < b.v : a.u < b.u;
}

}  // namespace omma
