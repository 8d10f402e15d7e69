// Where the frames of one camera's recording lie: a folder of image files (frame_folder.hpp), or a file of
// messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/camera.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {

class FrameStore {
 public:
  virtual ~FrameStore() = default;
  virtual std::size_t count() const = 0;
  /// Of the trigger that frame `i` belongs to; they rise.
  virtual std::uint64_t number(std::size_t i) const = 0;
  /// It was taken with; exposure 0: not known.
  virtual CameraSettings settings(std::size_t /*i*/) const { return {}; }
  /// For messages.
  virtual std::string name(std::size_t i) const = 0;
  /// @throws InputError where the frame is not readable
  virtual ImageSize size(std::size_t i) = 0;
  /// Into `image`, whose storage is used again where it is large enough. By one thread at a time.
  /// @throws InputError as above; then the image is undefined
  virtual void read(std::size_t i, Image& image) = 0;
};

}  // namespace omma
