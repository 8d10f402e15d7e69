#include "fsw/app/mcap_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

bool is_of_camera(std::string_view topic, std::string_view camera) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  return topic.starts_with(camera) && (topic.size() == camera.size() || topic[camera.size()] == '/');
}

}  // namespace

McapFrames::McapFrames(const std::filesystem::path& file, const std::string& camera, double frame_rate_hz)
    : path_(file.string()), reader_(path_) {
  find(camera);
  if (entries_.empty())
    throw InputError(path_, 0, "recording",
                     "images (sensor_msgs/msg/Image or CompressedImage) on a topic of /" + camera, "none");
  give_numbers(frame_rate_hz);
}

void McapFrames::find(const std::string& camera) {
  const auto kind_of = [this](const mcap::Channel& channel) {
    const auto schema = reader_.schemas().find(channel.schema);
    return schema == reader_.schemas().end() ? RosImageKind::kNone : ros_image_kind(schema->second.name);
  };
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::string topic;
  reader_.for_each_message(
      [&](const mcap::Channel& channel) { return kind_of(channel) != RosImageKind::kNone; },
      [&](const mcap::MessageView& message) {
        const mcap::Channel& channel = reader_.channels().at(message.channel);
        const std::int64_t stamp = ros_stamp_ns(message.data, path_ + " " + channel.topic);
        first = std::min(first, stamp);
        if (!is_of_camera(channel.topic, camera)) return true;
        if (!topic.empty() && topic != channel.topic)
          throw InputError(path_, 0, "recording", "images of " + camera + " on one topic",
                           topic + " and " + channel.topic);
        topic = channel.topic;
        entries_.push_back({stamp, 0, kind_of(channel), message.chunk, message.offset});
        return true;
      });
  first_stamp_ns_ = first;
}

void McapFrames::give_numbers(double frame_rate_hz) {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp_ns < b.stamp_ns; });
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const double seconds = static_cast<double>(entries_[i].stamp_ns - first_stamp_ns_) * 1e-9;
    entries_[i].number = static_cast<std::uint64_t>(std::llround(seconds * frame_rate_hz));
    if (i > 0 && entries_[i].number == entries_[i - 1].number)
      throw InputError(
          path_, 0, "recording",
          "at most one image of a camera in 1/frame_rate_hz = " + std::to_string(1 / frame_rate_hz) + " s",
          "two at " + std::to_string(seconds) + " s");
  }
}

std::string McapFrames::name(std::size_t i) const {
  return path_ + ", image " + std::to_string(i + 1);
}

ImageSize McapFrames::size(std::size_t i) {
  Image image;
  read(i, image);
  return {image.width, image.height, 8 * image.bytes_per_pixel()};
}

void McapFrames::read(std::size_t i, Image& image) {
  const Entry& entry = entries_[i];
  const auto message = reader_.message_at(entry.chunk, entry.offset);
  if (!message) throw InputError(name(i), 0, "message", "the one that was there", "none");
  read_ros_image(entry.kind, message->data, name(i), image);
}

}  // namespace omma
