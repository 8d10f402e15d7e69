// Camera frames as ROS 2 records them: messages sensor_msgs/msg/Image (mono8, mono16, rgb8, bgr8 and OpenCV's
// names of them) and sensor_msgs/msg/CompressedImage (a PNG or JPEG file), in CDR of version 1,
// little-endian. Source: ROS 2 common_interfaces, sensor_msgs; DDS-XTypes 1.3, 7.4.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "hal/recorded/image_file.hpp"

namespace omma {

enum class RosImageKind : std::uint8_t { kNone, kImage, kCompressedImage };

/// By the name of a message's schema.
RosImageKind ros_image_kind(std::string_view schema);

/// The header's stamp [ns since its epoch]. @throws InputError where the message is no such image
std::int64_t ros_stamp_ns(std::span<const std::byte> message, const std::string& name);

/// The image, colour as its luminance. @param name  for messages
/// @throws InputError: cut short, another byte order, an encoding that is not understood
void read_ros_image(RosImageKind kind, std::span<const std::byte> message, const std::string& name,
                    Image& image);

}  // namespace omma
