// Pictures asked for while flying: commands become requests, which wait for the picture under way.
#pragma once

#include "components/imaging/camera_region.hpp"
#include "components/imaging/imaging_commands.hpp"
#include "components/imaging/ray_table.hpp"
#include "fsw/kernel/spsc_queue.hpp"

namespace omma {

/// A picture asked for while flying: made once, after the one that is being made. Angles as PictureSettings.
struct PictureRequest {
  ImageKind kind = ImageKind::kView;
  double pan = 0;         ///< [rad]
  double tilt = 0;        ///< [rad]
  double field = 0;       ///< of a view or fisheye [rad]; 0: the mission's
  bool fused = false;     ///< of several exposures; not of kCamera
  CameraRegion region{};  ///< of kCamera; at full depth
};

class PictureRequests {
 public:
  /// @param table  outlives this: sizes of the cameras' images
  explicit PictureRequests(const RayTable& table) : table_(table) {}

  /// One of request_picture, request_fused, request_region. Refused with the argument at fault, while the
  /// sender can still be told; busy where four wait already.
  CommandOutcome receive(const Command& command) noexcept;
  bool push(const PictureRequest& picture) noexcept { return waiting_.push(picture); }
  bool pop(PictureRequest& picture) noexcept { return waiting_.pop(picture); }

 private:
  CommandOutcome receive_look(const Command& command) noexcept;
  CommandOutcome receive_region(const Command& command) noexcept;

  const RayTable& table_;
  SpscQueue<PictureRequest, 4> waiting_;
};

}  // namespace omma
