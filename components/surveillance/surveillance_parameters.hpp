// What can be chosen about unknown objects.
#pragma once

namespace omma {

struct SurveillanceParameters {
  double largest_rate = 0.05;            ///< of an object against the stars [rad/s]
  double acceleration = 2e-4;            ///< of its direction, not modelled [rad/s²]
  double gate_chi2 = 13.8;               ///< a dot farther from the prediction is not the object's
  double ambiguity = 6.0;                ///< a rival that fits this nearly as well: neither is taken
  double detection_probability = 0.9;    ///< of an object in the field
  double false_objects_per_hour = 0.01;  ///< that chance may make of dots at random
  int least_sightings = 4;               ///< before an object is confirmed
  int patience = 30;            ///< frame sets in a row a confirmed object may be missed in the field
  double largest_sigma = 0.02;  ///< an object known worse than this is given up [rad]
};

}  // namespace omma
