// A recording as the ground programs read it: samples decoded into the C structs of the IDL.
//
//   Recording recording("demo.mcap");
//   recording.for_each<omma_Attitude>([&](const omma_Attitude& sample) { ... });
//   if (!recording.damage().empty()) warn(recording.damage());
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "components/telemetry/cdr.hpp"
#include "components/telemetry/mcap_reader.hpp"
#include "components/telemetry/topics.hpp"

namespace omma::ground {

class Recording {
 public:
  /// Throws InputError where the file cannot be opened or is no MCAP file.
  explicit Recording(const std::string& path) : reader_(path) {}

  /// Gives every sample of the topic that belongs to the struct, in the order they were written; the sample
  /// is valid during the call. Throws InputError where the recording describes that topic otherwise than this
  /// program's IDL does.
  template <class Sample>
  void for_each(const std::function<void(const Sample&)>& take) {
    for_each_decoded(telemetry::TopicOf<Sample>::id,
                     [&](const void* sample) { take(*static_cast<const Sample*>(sample)); });
  }

  /// All samples of a topic at once. Only for topics whose struct holds no sequence (attitude,
  /// relative_pose).
  template <class Sample>
  std::vector<Sample> all() {
    static_assert(std::is_same_v<Sample, omma_Attitude> || std::is_same_v<Sample, omma_RelativePose>,
                  "a sequence inside the struct would point at memory that is used again");
    std::vector<Sample> samples;
    for_each<Sample>([&](const Sample& sample) { samples.push_back(sample); });
    return samples;
  }

  /// Last part of the spacecraft's topics' names, omma/<spacecraft>/<topic>; empty when there is none.
  std::string spacecraft() const;
  /// Empty when the file is whole and sound as far as it was read, else one sentence.
  const std::string& damage() const { return reader_.damage(); }
  /// Samples whose bytes were not of their type.
  std::uint64_t undecodable() const { return undecodable_; }
  mcap::Reader& reader() { return reader_; }

 private:
  void for_each_decoded(telemetry::TopicId id, const std::function<void(const void*)>& take);

  mcap::Reader reader_;
  std::uint64_t undecodable_ = 0;
};

/// For a single pass over one topic: for_each<omma_Attitude>("demo.mcap", fn).
template <class Sample>
void for_each(const std::string& path, const std::function<void(const Sample&)>& take) {
  Recording recording(path);
  recording.for_each<Sample>(take);
}

}  // namespace omma::ground
