#include "components/extractor/camera_dots.hpp"

#include <algorithm>

namespace omma {
namespace {

// The sky has moved where at most this share of the brightest dots are still where they were.
constexpr int kStillOneIn = 5;
constexpr float kMoved = 4;  // [px]

}  // namespace

CameraDots::CameraDots(const ExtractorCamera& camera)
    : has_black_frame_(!camera.sensor.black.empty()),
      correction_(camera.width, camera.height, camera.sensor),
      mask_(camera.mask),
      has_mask_(camera.mask.any()),
      illumination_(camera.illumination),
      extractor_(camera.width, camera.height),
      tiles_(camera.width, camera.height),
      level_row_(static_cast<std::size_t>(camera.width)) {
  tune(camera.parameters);
  if (!camera.glare) return;
  glare_.emplace(camera.width, camera.height, *camera.glare);
  mask_now_ = PixelMask(camera.width, camera.height);
  if (mask_.width() == 0) mask_ = mask_now_;
}

void CameraDots::tune(const ExtractorParameters& parameters) noexcept {
  parameters_ = parameters;
  if (has_black_frame_) parameters_.black_level = static_cast<float>(correction_.black_level());
}

const PixelMask* CameraDots::masked(const ImageView& image) noexcept {
  if (!glare_) return has_mask_ ? &mask_ : nullptr;
  mask_now_.clear();
  const bool any = glare_->add_to(image, mask_now_) > 0;
  if (!any) return has_mask_ ? &mask_ : nullptr;
  mask_now_.add(mask_);
  return &mask_now_;
}

void CameraDots::find(const ImageView& raw, DotList& list, const CameraWindows* where) noexcept {
  const PixelMask* blind = masked(raw);
  const ImageView image = correction_.correct(raw);
  list.everywhere = where == nullptr || where->everywhere;
  if (!list.everywhere) tiles_.set(where->windows);
  extractor_.extract(image, parameters_, {blind, correction_.bad_pixels()}, list,
                     list.everywhere ? nullptr : &tiles_);
  list.masked = blind == nullptr ? 0.0F : static_cast<float>(blind->share());
  if (correction_.ages()) age(list);
  if (illumination_.empty()) return;
  for (Dot& dot : list.dots) dot.flux /= illumination_.at(dot.pixel);
}

// Stars that stay on their pixels would be taken for dark current.
bool CameraDots::sky_has_moved(const DotList& list) noexcept {
  int still = 0;
  for (const Eigen::Vector2f& before : aged_at_) {
    still += std::any_of(list.dots.begin(), list.dots.end(),
                         [&](const Dot& dot) {
                           return (dot.pixel.cast<float>() - before).squaredNorm() < kMoved * kMoved;
                         })
                 ? 1
                 : 0;
  }
  return aged_at_.empty() || kStillOneIn * still <= static_cast<int>(aged_at_.size());
}

// Some rows of each frame whose sky has moved since they last aged.
void CameraDots::age(const DotList& list) noexcept {
  if (next_aged_row_ == 0 && !sky_has_moved(list)) return;
  if (next_aged_row_ == 0) {
    aged_at_.clear();
    for (const Dot& dot : list.dots)
      if (!aged_at_.push_back(dot.pixel.cast<float>())) break;
  }
  const int height = extractor_.height();
  for (int v = next_aged_row_; v < height; v += FrameCorrection::kAgedRows) {
    for (std::size_t u = 0; u < level_row_.size(); ++u)
      level_row_[u] = extractor_.background().level(static_cast<float>(u), static_cast<float>(v));
    correction_.age_row(v, level_row_.data());
  }
  next_aged_row_ = (next_aged_row_ + 1) % FrameCorrection::kAgedRows;
}

}  // namespace omma
