// The logarithmic pixel of an HDR sensor: a photodiode as a solar cell, read without exposure and without
// shutter. Its voltage is (kT/q) ln(1 + light / dark current); gain and blacklevel are analog, before the
// converter. Sources: Ni, Zhu & Arion, A 768x576 logarithmic image sensor with photodiode in solar cell mode,
// IISW 2011; noise of a photodiode at its own bandwidth (kT/C, falling to half in light): Delbrueck & Mead,
// Caltech CNS memo 30, 1996. The numbers of the dissertation's camera: docs/algorithms/simulation.md.
#pragma once

namespace omma::sim {

struct LogResponse {
  double volts_per_decade = 0.0595;  ///< (kT/q) ln 10 at 300 K
  double dynamic_range_db = 120;     ///< light over dark current at which the pixel ends, 20 dB a decade
  double full_scale = 2;             ///< input range of the converter [V]
  double analog_gain = 20;
  double blacklevel = 157;         ///< offset of the signal before the gain, in steps
  double blacklevel_dark = 150;    ///< at which no light is grey level 0
  double blacklevel_step = 0.001;  ///< [V]
  double junction = 3000;          ///< charge C kT/q² that sets the thermal noise [electrons]
  double fixed_pattern = 0.0004;   ///< deviation of the pixels' own offsets [V]
  double read_noise = 0.0002;      ///< of amplifier and converter, before the gain [V]
};

/// One camera's, with its dark current and converter put in: electrons ↔ grey levels.
class LogPixel {
 public:
  /// @param dark  electrons that the dark current makes in the time in which light is counted, above 0
  LogPixel(const LogResponse& response, double dark, int bits);

  /// Grey level that `electrons` (dark current included) have in the mean, not cut at black and white.
  double level(double electrons) const;
  double electrons(double level) const;  ///< the inverse
  double slope(double electrons) const;  ///< grey levels per electron
  /// Deviation of one pixel from frame to frame [grey levels], quantisation left out.
  double noise(double electrons) const;
  double pattern() const { return pattern_; }  ///< deviation of the pixels' offsets [grey levels]
  double most() const { return most_; }        ///< electrons at which the pixel ends

 private:
  double dark_;
  double levels_per_fold_;  // of light, a factor e
  double offset_;           // grey level of no light
  double thermal_;          // variance of the logarithm in the dark
  double read_noise_;       // [grey levels]
  double pattern_;
  double most_;
};

}  // namespace omma::sim
