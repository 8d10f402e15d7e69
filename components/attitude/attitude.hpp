// Attitude: star pairings → rig_from_j2000 with covariance, by the one weighted least-squares solver.
#pragma once

#include "components/attitude/attitude_estimate.hpp"
#include "components/estimation/least_squares.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

struct AttitudeParameters {
  SolveOptions solve;
  int least_pairs = 4;  ///< fewer pairs after the cull give no attitude
};

class Attitude final : public Component {
 public:
  explicit Attitude(const AttitudeParameters& parameters) : parameters_(parameters) {}

  In<Pairings> pairings;
  Out<AttitudeEstimate> estimate;

  std::string_view name() const override { return "attitude"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  AttitudeParameters parameters_;
  StaticVector<Sight, limits::kStarPairs> sights_;
  bool has_last_ = false;
  TimeNs last_time_ns_ = 0;
  Eigen::Quaterniond last_ = Eigen::Quaterniond::Identity();
};

}  // namespace omma
