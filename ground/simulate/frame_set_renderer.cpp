#include "ground/simulate/frame_set_renderer.hpp"

#include "sim/truth_json.hpp"

namespace omma::ground {

std::vector<sim::CameraView> views_of(const sim::Scenario& scenario) {
  std::vector<sim::CameraView> views;
  for (std::size_t c = 0; c < scenario.rig.cameras.size(); ++c) {
    views.emplace_back(scenario.rig.cameras[c], scenario.sensors[c], scenario.seed, static_cast<int>(c));
  }
  return views;
}

FrameSetRenderer::FrameSetRenderer(const sim::Scenario& scenario, std::span<const SkyStar> stars,
                                   const std::vector<sim::CameraView>& views)
    : scenario_(scenario), views_(views), spots_(views.size()) {
  for (std::size_t c = 0; c < views.size(); ++c)
    cameras_.push_back(std::make_unique<sim::CameraRenderer>(scenario, stars, views[c], static_cast<int>(c)));
}

void FrameSetRenderer::draw(std::uint64_t frame) {
  frame_ = frame;
  for (const auto& camera : cameras_) camera->draw(frame);
}

std::string FrameSetRenderer::truth() {
  for (std::size_t c = 0; c < cameras_.size(); ++c) cameras_[c]->truth(spots_[c]);
  return sim::truth_line(scenario_, frame_, spots_);
}

ImageView FrameSetRenderer::image(std::size_t camera) {
  const sim::CameraView& view = views_[camera];
  const bool deep = view.sensor().bits > 8;
  image_.resize(view.width(), view.height(), deep ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
  image_.white_level = view.sensor().white_level();
  const std::size_t pixels = static_cast<std::size_t>(view.width()) * static_cast<std::size_t>(view.height());
  if (deep) {
    cameras_[camera]->read_out({reinterpret_cast<std::uint16_t*>(image_.pixels.data()), pixels});
  } else {
    cameras_[camera]->read_out({reinterpret_cast<std::uint8_t*>(image_.pixels.data()), pixels});
  }
  return image_.view();
}

}  // namespace omma::ground
