// UTC correlation: which UTC belongs to which on-board time, how well that is known, and where it comes from.
// In real time from the system's clock; in a replay from the mission's epoch, so that it is the same every
// time.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/utc_clock.hpp"

namespace omma {

enum class UtcSource : std::uint8_t {
  kNone,              ///< a replay without an epoch: UTC is not known
  kMissionEpoch,      ///< on-board time 0 is the mission's epoch
  kSystemClock,       ///< nothing keeps the system's clock: it may be anything
  kDisciplinedClock,  ///< the system's clock, kept by NTP or PPS
};

struct UtcReport {
  std::uint64_t tick = 0;
  TimeNs time_ns = 0;  ///< on-board time of the instant
  bool valid = false;  ///< false: UTC is not known
  UtcSource source = UtcSource::kNone;
  UtcNs utc_ns = 0;           ///< the same instant
  TimeNs uncertainty_ns = 0;  ///< largest error; kUnknown where nothing bounds it

  static constexpr TimeNs kUnknown = -1;
};

class UtcCorrelation final : public Component {
 public:
  enum class Kind : std::uint8_t {
    kLive,    ///< by the system's clock
    kReplay,  ///< by the epoch
  };
  /// @param epoch  UTC of on-board time 0 in a replay; none: not known
  UtcCorrelation(Kind kind, std::optional<UtcNs> epoch) : live_(kind == Kind::kLive), epoch_(epoch) {}

  Out<UtcReport> report;

  std::string_view name() const override { return "utc"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("report", report); }
  void step(const Tick& tick) noexcept override;

  /// On an ordinary thread, now and then: brings up to date what is known of the system's clock.
  void ask_system() noexcept;

 private:
  const bool live_;
  const std::optional<UtcNs> epoch_;
  std::atomic<TimeNs> error_ns_{UtcReport::kUnknown};  // of the system's clock
};

}  // namespace omma
