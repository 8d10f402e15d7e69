// Frames of a V4L2 capture device: memory-mapped buffers, buffers exported as DMA-buf file descriptors, or
// DMA-bufs of another owner's that the device fills.
#pragma once

#include <string>
#include <vector>

#include "hal/camera_setup.hpp"
#include "hal/live/frame_source.hpp"
#include "hal/v4l2/lent_memory.hpp"
#include "hal/v4l2/v4l2_device.hpp"

namespace omma {

class V4l2Source final : public FrameSource {
 public:
  /// @throws InputError: a format that is not understood, no size, or numbers out of range. The device is
  /// first touched by `start`.
  explicit V4l2Source(CameraSetup setup);
  ~V4l2Source() override { stop(); }
  V4l2Source(const V4l2Source&) = delete;
  V4l2Source& operator=(const V4l2Source&) = delete;

  std::string_view driver_name() const override { return "v4l2"; }
  GreyShape shape() const override { return shape_; }
  void start() override;
  void stop() noexcept override;
  Taken take(std::byte* pixels, int timeout_ms) noexcept override;
  /// Exposure, where the device has exposure_time_absolute, whose unit is known; the unit of a gain is not.
  CameraSettingsRange settings_range() const override;
  CameraSettings settings() const noexcept override { return {.exposure_ns = exposure_ns_}; }
  bool apply(const CameraSettings& settings) noexcept override;

 private:
  struct Buffer {
    void* memory = nullptr;
    std::size_t size = 0;
    int dma_file = -1;  // none of the device's own, mapped by its offset
  };

  [[noreturn]] void refuse(std::string_view field, const std::string& expected,
                           const std::string& found) const;
  void require(int error, std::string_view field, const std::string& expected) const;
  void open();
  void set_format();
  void set_rate() const;
  void find_exposure();
  void request_buffers();
  void borrow_buffers();
  void map_buffers();
  void map(Buffer& buffer, int file, off_t offset);
  bool borrows() const noexcept { return !setup_.memory_from.empty(); }
  v4l2_buffer buffer_query(std::uint32_t index) const noexcept;
  /// @return 0, or the errno
  int queue(std::uint32_t index) const noexcept;
  bool holds_whole_image(const v4l2_buffer& filled) const noexcept;
  bool read_out(const Buffer& buffer, std::byte* pixels) const noexcept;

  CameraSetup setup_;
  const PixelLayout* layout_;
  GreyShape shape_;
  v4l2::Device device_;
  LentMemory lender_;
  std::vector<Buffer> buffers_;
  std::ptrdiff_t stride_ = 0;
  std::size_t frame_bytes_ = 0;  // that the device asks of a buffer
  v4l2::Control exposure_;       // id 0: it has none
  TimeNs exposure_ns_ = 0;
  bool streaming_ = false;
};

}  // namespace omma
