#include "hal/sources/live_drivers.hpp"

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/libcamera_child.hpp"
#include "hal/shared_frames/shared_source.hpp"
#include "hal/v4l2/v4l2_source.hpp"

namespace omma {

std::vector<std::string_view> live_drivers() {
  return {"v4l2", "libcamera", "simulated"};
}

std::unique_ptr<FrameSource> make_frame_source(const std::string& driver, const CameraSetup& setup) {
  if (driver == "v4l2") return std::make_unique<V4l2Source>(setup);
  if (driver == "simulated") return std::make_unique<SharedSource>(setup);
  if (driver == "libcamera") return make_libcamera_source(setup);
  throw InputError(setup.where, 0, "driver", R"("v4l2", "libcamera" or "simulated")", driver);
}

}  // namespace omma
