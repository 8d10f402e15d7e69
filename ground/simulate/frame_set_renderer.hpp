// Renders frame sets of a scenario, one at a time, on the calling thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/recorded/image_file.hpp"
#include "sim/camera_renderer.hpp"
#include "sim/scenario.hpp"

namespace omma::ground {

/// One view for each camera of the rig.
std::vector<sim::CameraView> views_of(const sim::Scenario& scenario);

class FrameSetRenderer {
 public:
  /// All stay with the caller.
  FrameSetRenderer(const sim::Scenario& scenario, std::span<const SkyStar> stars,
                   const std::vector<sim::CameraView>& views);

  void draw(std::uint64_t frame);
  /// Of the frame set drawn last; valid until the next call.
  ImageView image(std::size_t camera);
  /// The line of truth of the frame set drawn last.
  std::string truth();

 private:
  const sim::Scenario& scenario_;
  const std::vector<sim::CameraView>& views_;
  std::vector<std::unique_ptr<sim::CameraRenderer>> cameras_;
  std::vector<std::vector<sim::SpotTruth>> spots_;
  std::uint64_t frame_ = 0;
  Image image_;
};

}  // namespace omma::ground
