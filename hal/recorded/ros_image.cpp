#include "hal/recorded/ros_image.hpp"

#include <cstring>

#include "fsw/kernel/input_error.hpp"
#include "hal/live/pixel_layout.hpp"

namespace omma {
namespace {

/// Takes what a CDR message holds off its front. @throws InputError where there is less
class CdrCursor {
 public:
  CdrCursor(std::span<const std::byte> message, const std::string& name) : name_(name) {
    constexpr std::size_t kHead = 4;  // encapsulation
    if (message.size() < kHead) cut_short();
    if (message[0] != std::byte{0} || message[1] != std::byte{1})
      throw InputError(name_, 0, "message", "little-endian CDR", "another encoding");
    bytes_ = message.subspan(kHead);
  }
  std::uint8_t byte() { return std::to_integer<std::uint8_t>(take(1)[0]); }
  std::uint32_t number() {
    at_ = (at_ + 3) / 4 * 4;
    std::uint32_t value = 0;
    const std::span<const std::byte> raw = take(4);
    for (std::size_t i = 0; i < raw.size(); ++i) value |= std::to_integer<std::uint32_t>(raw[i]) << (8 * i);
    return value;
  }
  std::string_view text() {
    const std::span<const std::byte> raw = take(number());
    if (raw.empty()) return {};
    return {reinterpret_cast<const char*>(raw.data()), raw.size() - 1};  // without the closing zero
  }
  std::span<const std::byte> bytes() { return take(number()); }

 private:
  [[noreturn]] void cut_short() const {
    throw InputError(name_, 0, "message", "a whole image", "one that is cut short");
  }
  std::span<const std::byte> take(std::size_t count) {
    if (at_ > bytes_.size() || count > bytes_.size() - at_) cut_short();
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

  const std::string& name_;
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

std::int64_t stamp(CdrCursor& cursor) {
  const auto seconds = static_cast<std::int32_t>(cursor.number());
  const std::uint32_t nanoseconds = cursor.number();
  return std::int64_t{seconds} * 1'000'000'000 + nanoseconds;
}

std::string_view layout_name(std::string_view encoding) {
  if (encoding == "mono8" || encoding == "8UC1") return "GREY";
  if (encoding == "mono16" || encoding == "16UC1") return "Y16";
  if (encoding == "rgb8") return "RGB3";
  if (encoding == "bgr8" || encoding == "8UC3") return "BGR3";
  return {};
}

void read_raw(CdrCursor& cursor, const std::string& name, Image& image) {
  const std::uint32_t height = cursor.number();
  const std::uint32_t width = cursor.number();
  const std::string_view encoding = cursor.text();
  const bool big_endian = cursor.byte() != 0;
  const std::uint32_t stride = cursor.number();
  const std::span<const std::byte> pixels = cursor.bytes();
  const PixelLayout* const layout = find_pixel_layout(layout_name(encoding));
  if (layout == nullptr) throw InputError(name, 0, "encoding", "mono8, mono16, rgb8 or bgr8", encoding);
  if (big_endian && layout->bits > 8)
    throw InputError(name, 0, "is_bigendian", "0 for pixels of 16 bits", "1");
  if (width < 1 || height < 1 || width > kImageFileSide || height > kImageFileSide)
    throw InputError(name, 0, "size", "sides of 1 to " + std::to_string(kImageFileSide) + " px",
                     std::to_string(width) + " x " + std::to_string(height));
  if (stride < width * static_cast<std::uint32_t>(layout->bytes) ||
      pixels.size() < std::size_t{stride} * height)
    throw InputError(name, 0, "data", "all rows of the image",
                     std::to_string(pixels.size()) + " bytes in rows of " + std::to_string(stride));
  const GreyShape shape =
      grey_shape(*layout, BayerUse::kRaw, static_cast<int>(width), static_cast<int>(height));
  image.resize(shape.width, shape.height, shape.format);
  to_grey(*layout, BayerUse::kRaw, pixels.data(), static_cast<std::ptrdiff_t>(stride), shape,
          image.pixels.data());
}

}  // namespace

RosImageKind ros_image_kind(std::string_view schema) {
  if (schema == "sensor_msgs/msg/Image") return RosImageKind::kImage;
  if (schema == "sensor_msgs/msg/CompressedImage") return RosImageKind::kCompressedImage;
  return RosImageKind::kNone;
}

std::int64_t ros_stamp_ns(std::span<const std::byte> message, const std::string& name) {
  CdrCursor cursor(message, name);
  return stamp(cursor);
}

void read_ros_image(RosImageKind kind, std::span<const std::byte> message, const std::string& name,
                    Image& image) {
  CdrCursor cursor(message, name);
  stamp(cursor);
  cursor.text();  // the frame of reference
  if (kind == RosImageKind::kImage) {
    read_raw(cursor, name, image);
  } else {
    cursor.text();  // the format, which the file's first bytes say as well
    read_image_bytes(cursor.bytes(), name, image);
  }
}

}  // namespace omma
