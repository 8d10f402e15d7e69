#include "ground/mask/mask.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "components/extractor/background_map.hpp"
#include "components/sensor/pixel_mask.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

constexpr int kLeastFrames = 3;

struct MaskArguments {
  std::vector<std::string> frames;
  std::string output;
  double deviations = 4;
  int grow = 2;
};

// Counts, pixel by pixel, the frames in which it stands out over or under its surroundings.
class Standing {
 public:
  Standing(int width, int height)
      : width_(width),
        height_(height),
        over_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        under_(over_.size()),
        background_(width, height) {}

  void add(const ImageView& image, double deviations) {
    background_.build(image, false);
    std::size_t i = 0;
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u, ++i) {
        const int grey = image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u]
                                                             : image.row<std::uint16_t>(v)[u];
        const auto x = static_cast<float>(u);
        const auto y = static_cast<float>(v);
        const auto excess = static_cast<double>(static_cast<float>(grey) - background_.level(x, y));
        const double limit = deviations * static_cast<double>(background_.noise(x, y));
        over_[i] = over_[i] + (excess > limit ? 1 : 0);
        under_[i] = under_[i] + (excess < -limit ? 1 : 0);
      }
    }
  }
  PixelMask in_all(int frames) const {
    PixelMask mask(width_, height_);
    std::size_t i = 0;
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u, ++i)
        if (over_[i] == frames || under_[i] == frames) mask.add_box(u, v, u, v);
    return mask;
  }

 private:
  int width_, height_;
  std::vector<int> over_, under_;
  BackgroundMap background_;
};

int mask(const MaskArguments& arguments) {
  if (arguments.frames.size() < kLeastFrames)
    throw InputError("arguments", 0, "frames", format("at least %d, of a sky that moves", kLeastFrames),
                     std::to_string(arguments.frames.size()));
  std::unique_ptr<Standing> standing;
  int width = 0, height = 0;
  for (const std::string& file : arguments.frames) {
    const Image frame = read_image(file);
    if (!standing) {
      width = frame.width;
      height = frame.height;
      standing = std::make_unique<Standing>(width, height);
    }
    if (frame.width != width || frame.height != height)
      throw InputError(file, 0, "size", format("%d x %d pixels, as the first frame", width, height),
                       format("%d x %d", frame.width, frame.height));
    standing->add(frame.view(), arguments.deviations);
  }
  PixelMask found = standing->in_all(static_cast<int>(arguments.frames.size()));
  found.grow(arguments.grow);
  Image picture;
  picture.resize(width, height, PixelFormat::kGrey8);
  std::size_t i = 0;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) picture.pixels[i++] = found.at(u, v) ? std::byte{255} : std::byte{0};
  write_png(arguments.output, picture.view());
  std::printf("%zu frames of %d x %d pixels: %.3f %% stand still and are masked\n", arguments.frames.size(),
              width, height, 100 * found.share());
  return 0;
}

}  // namespace

void add_mask(CLI::App& app, CommandContext& context) {
  auto a = std::make_shared<MaskArguments>();
  CLI::App* command =
      app.add_subcommand("mask", "Frames of a moving sky -> mask of what stands still in all of them");
  command->add_option("frames", a->frames, "PNG, JPEG or FITS, all of one size")->required();
  command->add_option("--output", a->output, "PNG to write, white where masked")->required();
  command->add_option("--deviations", a->deviations, "Standing out: standard deviations of a pixel")
      ->check(CLI::Range(1.0, 100.0));
  command->add_option("--grow", a->grow, "Pixels masked around what was found")->check(CLI::Range(0, 100));
  command->callback([a, &context] { context.exit_code = mask(*a); });
}

}  // namespace omma::ground
