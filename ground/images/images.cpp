// Every picture as a PNG; rows that did not come down are hatched, and the table says how many.
#include "ground/images/images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "ground/images/light_file.hpp"
#include "ground/recording.hpp"
#include "ground/report/chunk_pictures.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

constexpr int kHatchPeriod = 16;  // [px]
constexpr std::uint8_t kHatchGrey = 96;

struct Arguments {
  std::string recording;
  std::string out = ".";
};

const char* name_of(omma_ImageKind kind) {
  static constexpr std::array kNames{"panorama_j2000", "panorama_rig", "view",    "fisheye_j2000",
                                     "fisheye_rig",    "camera",       "view_rig"};
  const auto i = static_cast<std::size_t>(kind);
  return i < kNames.size() ? kNames[i] : "unknown";
}

const char* name_of(omma_ImageComposite composite) {
  static constexpr std::array kNames{"single", "mean", "darkest", "brightest", "fused"};
  const auto i = static_cast<std::size_t>(composite);
  return i < kNames.size() ? kNames[i] : "unknown";
}

/// A fused picture spans more than there is in it: its levels from its darkest to its brightest.
void stretch(const ChunkPicture& picture, GreyPicture& shown) {
  std::vector<std::uint16_t> seen;
  std::copy_if(picture.levels.begin(), picture.levels.end(), std::back_inserter(seen),
               [](std::uint16_t level) { return level > 0; });
  if (seen.empty()) return;
  std::sort(seen.begin(), seen.end());
  const double least = seen[seen.size() / 100];
  const double most = std::max(least + 1, static_cast<double>(seen.back()));
  for (std::size_t i = 0; i < shown.pixels.size(); ++i)
    if (picture.levels[i] > 0)
      shown.pixels[i] = static_cast<std::uint8_t>(
          std::lround(1 + 254 * std::clamp((picture.levels[i] - least) / (most - least), 0.0, 1.0)));
}

/// A gap in the link is not to look like a gap in the sky.
GreyPicture with_gaps_hatched(const ChunkPicture& picture) {
  GreyPicture shown = picture.picture;
  if (picture.composite == omma_COMPOSITE_FUSED) stretch(picture, shown);
  for (int v = 0; v < shown.height; ++v) {
    if (picture.rows[static_cast<std::size_t>(v)]) continue;
    for (int u = 0; u < shown.width; ++u) {
      if ((u + v) % kHatchPeriod < 2)
        shown.pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(shown.width) +
                     static_cast<std::size_t>(u)] = kHatchGrey;
    }
  }
  return shown;
}

std::string file_name(std::uint32_t number, const ChunkPicture& picture) {
  std::array<char, 80> name{};
  std::snprintf(name.data(), name.size(), "%05u_%s%s%s", number, name_of(picture.kind),
                picture.composite == omma_COMPOSITE_SINGLE ? "" : "_",
                picture.composite == omma_COMPOSITE_SINGLE ? "" : name_of(picture.composite));
  return name.data();
}

void write_look(const std::filesystem::path& file, const ChunkPicture& picture) {
  const GreyPicture shown = with_gaps_hatched(picture);
  ImageView view;
  view.data = reinterpret_cast<const std::byte*>(shown.pixels.data());
  view.width = shown.width;
  view.height = shown.height;
  view.stride = shown.width;
  write_png(file, view);
}

/// The levels themselves, at full depth.
void write_levels(const std::filesystem::path& file, const ChunkPicture& picture) {
  ImageView view;
  view.data = reinterpret_cast<const std::byte*>(picture.levels.data());
  view.width = picture.picture.width;
  view.height = picture.picture.height;
  view.stride = std::ptrdiff_t{2} * picture.picture.width;
  view.format = PixelFormat::kGrey16;
  view.white_level = static_cast<std::uint16_t>(picture.scale.largest());
  write_png(file, view);
}

/// @return what was written: the picture to look at, or a camera's own grey levels; of a fused one its light
/// as well.
std::string write(const std::filesystem::path& folder, std::uint32_t number, const ChunkPicture& picture) {
  const std::string name = file_name(number, picture);
  if (picture.scale.scale == ImageScale::kLinear && picture.scale.bits > 8) {
    write_levels(folder / (name + ".png"), picture);
    return name + ".png";
  }
  write_look(folder / (name + ".png"), picture);
  if (picture.composite != omma_COMPOSITE_FUSED) return name + ".png";
  write_light(folder / (name + ".fits"), picture);
  return name + ".png .fits";
}

std::string where(const ChunkPicture& picture) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::array<char, 80> text{};
  if (picture.kind == omma_IMAGE_CAMERA)
    std::snprintf(text.data(), text.size(), "camera %d from %d, %d", picture.camera, picture.left,
                  picture.top);
  else if (picture.kind == omma_IMAGE_PANORAMA_J2000 || picture.kind == omma_IMAGE_PANORAMA_RIG)
    std::snprintf(text.data(), text.size(), "the whole sky");
  else
    std::snprintf(text.data(), text.size(), "%.2f %+.2f, %.2f deg", picture.pan / kDegree,
                  picture.tilt / kDegree, picture.field / kDegree);
  return text.data();
}

int images(const Arguments& arguments) {
  Recording recording(arguments.recording);
  ChunkPictures pictures;
  recording.for_each<omma_ImageChunk>([&](const omma_ImageChunk& chunk) { pictures.take(chunk); });
  if (!recording.damage().empty()) std::fprintf(stderr, "omma: %s\n", recording.damage().c_str());
  if (pictures.pictures().empty())
    throw InputError(arguments.recording, 0, "image_chunk", "a picture at least", "none");
  std::error_code error;
  std::filesystem::create_directories(arguments.out, error);
  std::printf(
      "image  kind            of          size px      bits  frame sets      rows lost   bytes / pixel  "
      "looks at                  file\n");
  bool whole = true;
  for (const auto& [number, picture] : pictures.pictures()) {
    const int lost = picture.picture.height - picture.rows_there();
    const std::string name = write(arguments.out, number, picture);
    whole = whole && lost == 0;
    const double pixels = static_cast<double>(picture.rows_there()) * picture.picture.width;
    std::printf("%5u  %-14s  %-9s%3d  %5d x %-5d  %4d %6llu to %-6llu  %5d       %6.3f         %-24s  %s\n",
                number, name_of(picture.kind), name_of(picture.composite), picture.composed,
                picture.picture.width, picture.picture.height, picture.scale.bits,
                static_cast<unsigned long long>(picture.first_frame),
                static_cast<unsigned long long>(picture.last_frame), lost,
                static_cast<double>(picture.bytes) / pixels, where(picture).c_str(), name.c_str());
  }
  if (pictures.refused() > 0)
    std::fprintf(stderr, "omma: %llu chunks contradict themselves or their picture and were left out\n",
                 static_cast<unsigned long long>(pictures.refused()));
  return whole && pictures.refused() == 0 ? 0 : 1;
}

}  // namespace

void add_images(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "images", "Pictures of a recording, put together from their chunks; exit code 1 where rows are lost");
  command->add_option("recording", arguments->recording, "recording (MCAP)")->required();
  command->add_option("--out", arguments->out, "folder for the PNG files");
  command->callback([arguments, &context] { context.exit_code = images(*arguments); });
}

}  // namespace omma::ground
