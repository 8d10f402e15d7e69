#include "components/extractor/camera_dots.hpp"

#include <algorithm>

namespace omma {
namespace {

// The sky has moved where at most this share of the brightest dots are still where they were.
constexpr int kStillOneIn = 5;
constexpr float kMoved = 4;     // [px]
constexpr double kSameDot = 2;  // found by two searches [px]

}  // namespace

CameraDots::Search::Search(int width, int height, const ExtractorParameters& p) : parameters(p) {
  if (p.algorithm == ExtractorAlgorithm::kMatched) {
    matched = std::make_unique<DotExtractor>(width, height);
  } else {
    classical = std::make_unique<ClassicalExtractor>(width, height, p);
  }
}

void CameraDots::Search::find(const ImageView& image, const ImageMasks& masks, const WindowTiles* windows,
                              DotList& list) noexcept {
  if (matched) {
    matched->extract(image, parameters, masks, list, windows);
  } else {
    classical->extract(image, parameters, masks.blind, list);
  }
}

CameraDots::CameraDots(const ExtractorCamera& camera)
    : height_(camera.height),
      best_((1 + camera.also.size()) * limits::kDotsPerCamera),
      has_black_frame_(!camera.sensor.black.empty()),
      correction_(camera.width, camera.height, camera.sensor),
      mask_(camera.mask),
      has_mask_(camera.mask.any()),
      illumination_(camera.illumination),
      tiles_(camera.width, camera.height),
      level_row_(static_cast<std::size_t>(camera.width)) {
  searches_.emplace_back(camera.width, camera.height, camera.parameters);
  for (const ExtractorParameters& other : camera.also)
    searches_.emplace_back(camera.width, camera.height, other);
  if (!camera.also.empty()) {
    others_ = std::make_unique<DotList>();
    found_.reserve(searches_.size() * limits::kDotsPerCamera);
  }
  tune(camera.parameters);
  if (!camera.glare) return;
  glare_.emplace(camera.width, camera.height, *camera.glare);
  mask_now_ = PixelMask(camera.width, camera.height);
  if (mask_.width() == 0) mask_ = mask_now_;
}

void CameraDots::tune(const ExtractorParameters& parameters) noexcept {
  searches_.front().parameters = parameters;
  for (Search& search : searches_) {
    search.parameters.gain = parameters.gain;
    search.parameters.black_level =
        has_black_frame_ ? static_cast<float>(correction_.black_level()) : parameters.black_level;
  }
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
  // What is not expected where it was may be anything: windows are for the search by the matched filter
  // alone.
  const bool windowed =
      where != nullptr && !where->everywhere && searches_.size() == 1 && searches_.front().matched != nullptr;
  list.everywhere = !windowed;
  if (windowed) tiles_.set(where->windows);
  const ImageMasks masks{blind, correction_.bad_pixels()};
  searches_.front().find(image, masks, windowed ? &tiles_ : nullptr, list);
  if (searches_.size() > 1) add_others(image, masks, list);
  list.masked = blind == nullptr ? 0.0F : static_cast<float>(blind->share());
  if (correction_.ages()) age(list);
  if (illumination_.empty()) return;
  for (Dot& dot : list.dots) dot.flux /= illumination_.at(dot.pixel);
}

// A dot that lies on one found before is that one.
void CameraDots::add_others(const ImageView& image, const ImageMasks& masks, DotList& list) noexcept {
  found_.assign(list.dots.begin(), list.dots.end());
  std::uint32_t dropped = list.dropped;
  for (std::size_t s = 1; s < searches_.size(); ++s) {
    searches_[s].find(image, masks, nullptr, *others_);
    dropped += others_->dropped;
    const auto before = found_.begin() + static_cast<std::ptrdiff_t>(found_.size());
    for (const Dot& dot : others_->dots) {
      const bool known = std::any_of(found_.begin(), before, [&](const Dot& other) {
        return (other.pixel - dot.pixel).squaredNorm() < kSameDot * kSameDot;
      });
      if (!known) found_.push_back(dot);
    }
  }
  best_.hand_over(found_, dropped, list);
}

const BackgroundMap& CameraDots::background() const noexcept {
  const Search& search = searches_.front();
  return search.matched ? search.matched->background() : search.classical->background();
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
  for (int v = next_aged_row_; v < height_; v += FrameCorrection::kAgedRows) {
    for (std::size_t u = 0; u < level_row_.size(); ++u)
      level_row_[u] = background().level(static_cast<float>(u), static_cast<float>(v));
    correction_.age_row(v, level_row_.data());
  }
  next_aged_row_ = (next_aged_row_ + 1) % FrameCorrection::kAgedRows;
}

}  // namespace omma
