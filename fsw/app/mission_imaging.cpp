#include "fsw/app/mission_imaging.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

namespace omma {
namespace {

// One of `names` by its place among them.
template <std::size_t kCount>
std::size_t one_of(const TomlTable& table, std::string_view key,
                   const std::array<std::string_view, kCount>& names) {
  const std::string found = table.text(key, std::string(names[0]));
  std::string all;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (found == names[i]) return i;
    all += (i == 0 ? "\"" : i + 1 == kCount ? " or \"" : ", \"") + std::string(names[i]) + "\"";
  }
  throw table.error(key, all, found);
}

// A part of a camera's image: left, top, width, height.
CameraRegion read_region(const TomlTable& table, const Rig& rig) {
  const std::string name = table.text("camera");
  CameraRegion region;
  const auto& cameras = rig.cameras;
  const auto* camera =
      std::find_if(cameras.begin(), cameras.end(), [&](const RigCamera& c) { return c.name.view() == name; });
  if (camera == cameras.end())
    throw table.error("camera", "a camera of the rig " + std::string(rig.name.view()), name);
  region.camera = static_cast<int>(camera - cameras.begin());
  const auto numbers = table.numbers("region_px", 4);
  region.left = static_cast<int>(numbers[0]);
  region.top = static_cast<int>(numbers[1]);
  region.width = static_cast<int>(numbers[2]);
  region.height = static_cast<int>(numbers[3]);
  const bool inside = region.left >= 0 && region.top >= 0 && region.width > 0 && region.height > 0 &&
                      region.left + region.width <= camera->lens.width() &&
                      region.top + region.height <= camera->lens.height();
  if (!inside) {
    throw table.error("region_px",
                      "left, top, width, height within " + std::to_string(camera->lens.width()) + " x " +
                          std::to_string(camera->lens.height()),
                      "a region beyond it");
  }
  return region;
}

}  // namespace

ImagingParameters read_imaging(const TomlTable& table, const Rig& rig) {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr std::array<std::string_view, 7> kKinds{
      "panorama_j2000", "panorama_rig", "view", "fisheye_j2000", "fisheye_rig", "camera", "view_rig"};
  constexpr std::array<std::string_view, 5> kComposites{"single", "mean", "darkest", "brightest", "fused"};
  ImagingParameters p;
  p.kind = static_cast<ImageKind>(one_of(table, "kind", kKinds));
  p.composite = static_cast<ImageComposite>(one_of(table, "composite", kComposites));
  const bool fused = p.composite == ImageComposite::kFused;
  const bool once = p.composite == ImageComposite::kSingle || fused;
  const Range many = once ? Range{1, 1} : Range{2, 1000};
  p.composed = static_cast<int>(table.integer("composed", many, once ? 1 : 10));
  p.fused_frame_sets = static_cast<int>(table.integer("fused_frame_sets", {2, 64}, p.fused_frame_sets));
  p.fused_bits = static_cast<int>(table.integer("fused_bits", {8, 16}, p.fused_bits));
  if (fused && p.kind == ImageKind::kCamera)
    throw table.error("composite", "no \"fused\" where kind is \"camera\": a picture on the sphere", "it");
  p.composed_rows = static_cast<int>(table.integer("composed_rows", {1, 4096}, p.composed_rows));
  p.compress = table.flag("compress", false);
  p.panorama.width = static_cast<int>(table.integer("panorama_width", {64, 4096}, p.panorama.width));
  p.view.width = static_cast<int>(table.integer("view_width", {16, 4096}, p.view.width));
  p.view.height = static_cast<int>(table.integer("view_height", {16, 4096}, p.view.height));
  p.view.horizontal_fov = kDegree * table.number("view_fov_deg", {0.1, 170}, p.view.horizontal_fov / kDegree);
  p.fisheye.size = static_cast<int>(table.integer("fisheye_size", {16, 4096}, p.fisheye.size));
  p.fisheye.field = kDegree * table.number("fisheye_field_deg", {1, 360}, p.fisheye.field / kDegree);
  p.pan = kDegree * table.number("pan_deg", {-360, 360}, 0);
  p.tilt = kDegree * table.number("tilt_deg", {-90, 90}, 0);
  const double white = table.number("white", {1e-4, 1}, p.panorama.white);
  p.panorama.white = p.view.white = p.fisheye.white = white;
  p.period = static_cast<int>(table.integer("period", {1, 100000}, 10));
  if (p.kind == ImageKind::kCamera) {
    p.region = read_region(table, rig);
    p.raw = table.flag("raw", false);
    if (p.raw && p.composite != ImageComposite::kSingle)
      throw table.error("raw", "false where pictures are composed", "true");
  }
  table.refuse_unknown_keys();
  return p;
}

}  // namespace omma
