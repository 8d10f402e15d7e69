// Whether the fields of two samples differ by more than a tolerance allows.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ground/compare/recording_difference.hpp"
#include "ground/idl/cdr_values.hpp"

namespace omma::ground {

class FieldJudge {
 public:
  FieldJudge(const Tolerance& tolerance, std::string topic)
      : tolerance_(tolerance), topic_(std::move(topic)) {}

  /// Learns how large a field gets: what a relative tolerance is relative to. All samples first, then judge.
  void measure(const std::vector<idl::Leaf>& leaves);
  /// The first field that differs too much, as a sentence; empty where none does.
  std::string difference(const std::vector<idl::Leaf>& a, const std::vector<idl::Leaf>& b);
  /// The field that came nearest to its tolerance, or exceeded it most, as a sentence; empty where none
  /// differed.
  std::string largest() const { return largest_; }

 private:
  double allowed(const std::string& field, bool whole) const;

  const Tolerance& tolerance_;
  std::string topic_;
  std::map<std::string, double> magnitude_;  // by field, without the places in its sequences
  double worst_ = 0;                         // difference over what is allowed
  std::string largest_;
};

}  // namespace omma::ground
