#include "ground/capture/frame_folder.hpp"

#include <algorithm>

#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/exposures_file.hpp"

namespace omma::ground {

std::uint64_t FrameNumbers::by_time(TimeNs time_ns) const {
  if (period_ns_ <= 0) return 0;
  return static_cast<std::uint64_t>(std::max<TimeNs>(0, elapsed(start_ns_, time_ns) + period_ns_ / 2) /
                                    period_ns_);
}

std::uint64_t FrameNumbers::number(TimeNs time_ns, std::uint32_t sequence) {
  if (!last_) {
    start_ns_ = start_.of(time_ns);
    last_ = by_time(time_ns);
  } else if (sequence > last_sequence_) {
    *last_ += sequence - last_sequence_;
  } else {  // the device began to count anew
    last_ = std::max(*last_ + 1, by_time(time_ns));
  }
  last_sequence_ = sequence;
  return *last_;
}

FrameFolder::FrameFolder(const std::filesystem::path& top, const std::string& camera, PngEffort effort)
    : folder_(top / camera), camera_(camera), effort_(effort) {
  const std::filesystem::path index = folder_ / (camera + ".csv");
  std::error_code error;
  if (std::filesystem::exists(index, error))
    throw InputError(folder_.string(), 0, "--output", "a folder without frames", "an earlier capture");
  std::filesystem::create_directories(folder_, error);
  index_.open(index);
  if (error || !index_)
    throw InputError(folder_.string(), 0, "--output", "a folder that can be written", "none");
  index_ << "number,time_ns,sequence\n";
}

void FrameFolder::write(std::uint64_t number, const LiveFrame& frame) {
  const std::vector<std::byte> png = encode_png(frame.image, effort_);
  const std::filesystem::path file = folder_ / (camera_ + "_" + std::to_string(number) + ".png");
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  stream.flush();
  index_ << number << ',' << frame.time_ns << ',' << frame.sequence << '\n';
  if (frame.settings.exposure_ns > 0) {
    if (!exposures_.is_open()) {
      exposures_.open(folder_ / kExposuresFile);
      exposures_ << kExposuresHeading << '\n';
    }
    exposures_ << exposure_line(number, frame.settings);
  }
  if (!stream || !index_ || !exposures_)
    throw InputError(file.string(), 0, "file", "a disk with room", "one that takes no more");
  ++frames_;
  bytes_ += png.size();
}

}  // namespace omma::ground
