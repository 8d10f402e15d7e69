// What the driver of a live camera is told at start-up, whatever the driver: the same words for all of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omma {

/// What becomes of a colour mosaic. Binning halves both sides.
enum class BayerUse : std::uint8_t {
  kRaw,    ///< every pixel as it is
  kGrey,   ///< mean of each 2 x 2 cell
  kGreen,  ///< mean of the two greens of each 2 x 2 cell
};

/// One setting of a camera: exposure, gain, blacklevel, gamma, trigger, or a name of the device's own.
struct CameraControl {
  std::string name;
  std::string value;  ///< a whole number, or the words of a menu's item
};

struct CameraSetup {
  std::string where{};          ///< for messages: the file (and table) that says so
  std::string device{};         ///< path, or name of the card or its place on the bus
  std::string format = "GREY";  ///< of the pixels as the device names it (`omma cameras` lists them)
  int width = 0;                ///< of the image delivered, after binning [px]
  int height = 0;               ///< [px]
  double frame_rate_hz = 0;     ///< asked of the device; 0: as it is
  BayerUse bayer = BayerUse::kGrey;
  int bits = 0;     ///< that the sensor fills of each pixel: the white level is 2^bits - 1; 0: the format's
  int buffers = 4;  ///< in the device's queue
  bool dma_buf = false;  ///< buffers are DMA-bufs, read between sync marks: the device's own, exported, or
  std::string memory_from{};  ///< those of another owner: path of a DMA heap or of another video device
  int timeout_ms = 2000;      ///< silence after which the stream is started anew
  std::vector<CameraControl> controls{};
  std::vector<CameraControl> control_names{};  ///< our name, the device's: before the usual mapping
};

}  // namespace omma
