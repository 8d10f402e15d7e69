// Where telemetry goes: DDS, a log. Called on the telemetry thread, never on a real-time one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "components/telemetry/topics.hpp"

namespace omma::telemetry {

class Sink {
 public:
  virtual ~Sink() = default;

  /// @param sample  the C struct of the topic
  /// @param cdr     the same, serialised, with its encapsulation header
  virtual void write(TopicId id, const void* sample, std::span<const std::byte> cdr) = 0;
  /// Nothing is written afterwards.
  virtual void close() {}

  /// Samples that did not get through, since the start.
  virtual std::uint64_t lost() const = 0;
  /// True for the log: its losses are part of the health report.
  virtual bool is_log() const { return false; }
  /// Empty while all is well, else what went wrong, in a sentence.
  virtual std::string failure() const = 0;
};

}  // namespace omma::telemetry
