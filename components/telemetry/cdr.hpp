// Samples to CDR bytes and back, with Cyclone's own marshalling code, so that what is logged is what is on
// the wire: XCDR version 1, little endian, four bytes of encapsulation header first (DDS-XTypes 1.3, 7.6.2).
// Needs no DDS participant, hence no network.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "components/telemetry/topics.hpp"

struct dds_ostream;  // Cyclone's, in dds/ddsi/ddsi_cdrstream.h

namespace omma::telemetry {

/// Owns the buffer that samples are written to; it grows to the largest sample and is then kept.
class CdrWriter {
 public:
  CdrWriter();
  ~CdrWriter();
  CdrWriter(const CdrWriter&) = delete;
  CdrWriter& operator=(const CdrWriter&) = delete;

  /// @param sample  the C struct that belongs to the topic
  /// @return the bytes, valid until the next write; empty if the sample breaks a bound of the IDL
  std::span<const std::byte> write(TopicId id, const void* sample);

 private:
  dds_ostream* stream_;
};

/// What every sample begins with, read from the bytes without decoding the rest.
struct SampleHead {
  std::uint64_t frame = 0;
  std::int64_t time_ns = 0;
  std::uint32_t sample_number = 0;
  bool valid = false;
};
/// @return false where the bytes are too few or not little-endian XCDR1
bool read_head(std::span<const std::byte> cdr, SampleHead& head) noexcept;

/// Holds decoded samples of one topic, one at a time; sequences keep their memory from sample to sample.
class CdrReader {
 public:
  explicit CdrReader(TopicId id);
  ~CdrReader();
  CdrReader(const CdrReader&) = delete;
  CdrReader& operator=(const CdrReader&) = delete;

  /// Checks the bytes against the type (lengths, bounds, enumerators) before anything is read from them.
  /// @return the sample, valid until the next read; null where the bytes are not a sample of this topic
  const void* read(std::span<const std::byte> cdr);

  template <class Sample>
  const Sample* read_as(std::span<const std::byte> cdr) {
    return TopicOf<Sample>::id == id_ ? static_cast<const Sample*>(read(cdr)) : nullptr;
  }

 private:
  TopicId id_;
  std::vector<std::uint64_t> bytes_;   // a copy, aligned, that checking may alter
  std::vector<std::uint64_t> sample_;  // the C struct
};

}  // namespace omma::telemetry
