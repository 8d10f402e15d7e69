// The bearing history of each unknown object of a recording.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "components/telemetry/topics.hpp"

namespace omma::ground {

struct Bearing {
  std::int64_t time_ns = 0;                              ///< exposure midpoint, on-board time
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector, J2000
  double sigma = 0;                                      ///< each axis [rad]
};

struct ObjectHistory {
  omma_UnknownObject newest{};
  std::vector<Bearing> bearings;  ///< one a frame set in which it was seen
  unsigned cameras = 0;           ///< bits: all that saw it

  double arc() const;        ///< from the first bearing to the last [rad]
  double mean_rate() const;  ///< of the same; 0 for a single bearing [rad/s]
};

struct ObjectHistories {
  std::string spacecraft;
  std::int64_t first_time_ns = 0;  ///< of the first frame set in the recording
  std::map<std::uint32_t, ObjectHistory> objects;
};

/// @throws InputError where the file is no recording or holds no sample of unknown objects
ObjectHistories read_object_histories(const std::string& path);

/// CCSDS 503.0-B-2, Tracking Data Message (KVN): right ascension and declination in EME2000, a segment an
/// object.
/// @param epoch    Julian date, UTC, of the first frame set
/// @param created  of the file, as 2026-04-02T02:00:00
std::string tracking_data_message(const ObjectHistories& histories, double epoch, const std::string& created);

}  // namespace omma::ground
