// The frames of one camera in an MCAP file of ROS 2 messages (ros2 bag record -s mcap): those of a topic that
// begins with the camera's name, "/cam0/image_raw" or "/cam0/image_raw/compressed".
//
// Such a recording has no numbers of triggers: a frame's number is that of its stamp on the mission's grid,
// counted from the first image of the file, whichever camera's, so that frames of one instant stay together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "components/telemetry/mcap_reader.hpp"
#include "hal/recorded/frame_store.hpp"
#include "hal/recorded/ros_image.hpp"

namespace omma {

class McapFrames final : public FrameStore {
 public:
  /// Looks at every message. @throws InputError: no MCAP file, no images of that camera, two in one period, a
  /// message that is no image
  McapFrames(const std::filesystem::path& file, const std::string& camera, double frame_rate_hz);

  std::size_t count() const override { return entries_.size(); }
  std::uint64_t number(std::size_t i) const override { return entries_[i].number; }
  std::string name(std::size_t i) const override;
  ImageSize size(std::size_t i) override;
  void read(std::size_t i, Image& image) override;

 private:
  struct Entry {
    std::int64_t stamp_ns = 0;
    std::uint64_t number = 0;
    RosImageKind kind = RosImageKind::kNone;
    std::size_t chunk = 0;
    std::size_t offset = 0;
  };
  void find(const std::string& camera);
  void give_numbers(double frame_rate_hz);

  std::string path_;
  mcap::Reader reader_;
  std::vector<Entry> entries_;       // by rising number
  std::int64_t first_stamp_ns_ = 0;  // of all images
};

}  // namespace omma
