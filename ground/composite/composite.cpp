// Composites in the camera's own frame, from image files, at full depth; 16-bit PNG out.
#include "ground/composite/composite.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "components/imaging/exposure_fusion.hpp"
#include "fsw/kernel/input_error.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string how;
  std::vector<std::string> images;
  std::vector<double> exposures;
  double black = 0;
  FusionSensor sensor;
  std::string out;
};

double level(const ImageView& image, int u, int v) {
  return image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
}

std::vector<Image> read_all(const Arguments& arguments) {
  std::vector<Image> images;
  for (const std::string& file : arguments.images) {
    images.push_back(read_image(file));
    const Image& first = images.front();
    const Image& last = images.back();
    if (last.width != first.width || last.height != first.height)
      throw InputError(
          file, 0, "image",
          std::to_string(first.width) + " x " + std::to_string(first.height) + " px as the first",
          std::to_string(last.width) + " x " + std::to_string(last.height));
    if (last.white_level != first.white_level)
      throw InputError(file, 0, "image",
                       "the first image's white level, " + std::to_string(first.white_level),
                       std::to_string(last.white_level));
  }
  return images;
}

double combined(const Arguments& arguments, const std::vector<Image>& images, int u, int v) {
  double sum = 0;
  double least = level(images.front().view(), u, v);
  double most = least;
  for (const Image& image : images) {
    const double grey = level(image.view(), u, v);
    sum += grey;
    least = std::min(least, grey);
    most = std::max(most, grey);
  }
  if (arguments.how == "mean") return sum / static_cast<double>(images.size());
  return arguments.how == "darkest" ? least : most;
}

/// As 16 bits, whose largest is `white`.
void write(const std::string& file, int width, int height, const std::vector<float>& light, double white) {
  Image out;
  out.resize(width, height, PixelFormat::kGrey16);
  out.white_level = 65535;
  auto* pixels = reinterpret_cast<std::uint16_t*>(out.pixels.data());
  for (std::size_t i = 0; i < light.size(); ++i)
    pixels[i] = static_cast<std::uint16_t>(std::lround(std::clamp(light[i] / white, 0.0, 1.0) * 65535));
  write_png(file, out.view());
}

void fuse(const Arguments& arguments, const std::vector<Image>& images, std::vector<float>& light) {
  std::vector<ExposedImage> exposed;
  for (std::size_t i = 0; i < images.size(); ++i)
    exposed.push_back({images[i].view(), arguments.exposures[i], arguments.black});
  fuse_exposures(exposed, arguments.sensor, light);
  const float brightest = *std::max_element(light.begin(), light.end());
  write(arguments.out, images.front().width, images.front().height, light, std::max(1e-9F, brightest));
  std::printf("%zu exposures fused; 65535 is %.6g grey levels a second above black\n", images.size(),
              static_cast<double>(brightest));
}

int composite(const Arguments& arguments) {
  if (arguments.how == "fuse" && arguments.exposures.size() != arguments.images.size())
    throw InputError("arguments", 0, "--exposures",
                     std::to_string(arguments.images.size()) + " times, one an image",
                     std::to_string(arguments.exposures.size()));
  for (const double exposure : arguments.exposures)
    if (!(exposure > 0))
      throw InputError("arguments", 0, "--exposures", "seconds above 0", std::to_string(exposure));
  const std::vector<Image> images = read_all(arguments);
  const int width = images.front().width;
  const int height = images.front().height;
  std::vector<float> light(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (arguments.how == "fuse") {
    fuse(arguments, images, light);
    return 0;
  }
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      light[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)] =
          static_cast<float>(combined(arguments, images, u, v));
  write(arguments.out, width, height, light, images.front().white_level);
  std::printf("%s of %zu images; 65535 is %u grey levels\n", arguments.how.c_str(), images.size(),
              static_cast<unsigned>(images.front().white_level));
  return 0;
}

}  // namespace

void add_composite(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("composite", "One image of a sequence taken by a camera that stood still");
  command
      ->add_option("how", arguments->how,
                   "mean, darkest, brightest, or fuse (several exposures, linear sensor)")
      ->required()
      ->check(CLI::IsMember({"mean", "darkest", "brightest", "fuse"}));
  command->add_option("images", arguments->images, "image files of one size")->required();
  command->add_option("--exposures", arguments->exposures, "of fuse: seconds, one an image")->delimiter(',');
  command->add_option("--black", arguments->black, "of fuse: grey level of no light");
  command->add_option("--gain", arguments->sensor.gain, "of fuse: electrons a grey level")
      ->check(CLI::PositiveNumber);
  command->add_option("--read-noise", arguments->sensor.read_noise, "of fuse: electrons")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", arguments->out, "PNG file, 16 bits")->required();
  command->callback([arguments, &context] { context.exit_code = composite(*arguments); });
}

}  // namespace omma::ground
