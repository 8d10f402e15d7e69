// What `omma predict` found, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ground/design/expected_accuracy.hpp"
#include "ground/design/prediction.hpp"

namespace omma::ground {

struct AttitudePrediction {
  double magnitude = 0;
  Spread stars;
  Spread noise;    ///< σ of one axis, root mean square of three, over attitudes [rad]
  Spread total;    ///< with calibration [rad]
  Spread weakest;  ///< σ about the weakest axis, with calibration [rad]
  double unsolvable = 0;
  std::optional<MonteCarloCheck> check;
};

struct PosePrediction {
  std::string camera;  ///< the body is before it
  double range = 0;    ///< [m]
  std::optional<PredictedCovariance> predicted;
  Eigen::Vector3d sight = Eigen::Vector3d::UnitZ();  ///< unit, from the camera to the body, rig frame
  std::optional<MonteCarloCheck> check;
};

struct Prediction {
  double dot_sigma = 0;
  CalibrationError error;
  std::optional<AttitudePrediction> attitude;
  std::string body;
  std::vector<PosePrediction> poses;
};

std::string prediction_text(const Prediction& prediction);
std::string prediction_json(const Prediction& prediction);

}  // namespace omma::ground
