#include "ground/dots/dots.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "components/extractor/classical/pipelines.hpp"
#include "components/extractor/dot_extractor.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/annotate.hpp"
#include "ground/draw/stretch.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

struct DotsArguments {
  std::string image, algorithm = "omma", stages, annotated, black_frame;
  int bits = 0;
  ExtractorParameters extractor;
  ClassicalParameters classical;
  bool dark = false;
};

// A stage's numbers as 16 bits, from its least to its greatest, so that it can be shown like a photograph.
GreyPicture picture_of(const GreyImage& grey) {
  const auto [least, greatest] = std::minmax_element(grey.value.begin(), grey.value.end());
  const float scale = *greatest > *least ? 65535 / (*greatest - *least) : 0;
  Image image;
  image.resize(grey.width, grey.height, PixelFormat::kGrey16);
  image.white_level = 65535;
  auto* out = reinterpret_cast<std::uint16_t*>(image.pixels.data());
  bool binary = true;
  for (std::size_t i = 0; i < grey.value.size(); ++i) {
    out[i] = static_cast<std::uint16_t>(scale * (grey.value[i] - *least));
    binary = binary && (out[i] == 0 || out[i] == 65535);
  }
  return stretched(image.view(), binary ? Stretch{0, 65535, 0} : night_sky_stretch(image.view()));
}

// Writes the stages as 01_name.png, 02_name.png, …
StageObserver stage_writer(const std::string& folder) {
  if (folder.empty()) return {};
  make_folder(folder, "--stages");
  return [folder, number = 0](std::string_view name, const GreyImage& image) mutable {
    std::string file = format("%02d_", ++number);
    for (const char c : name) file += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    const GreyPicture picture = picture_of(image);
    const ImageView view{reinterpret_cast<const std::byte*>(picture.pixels.data()),
                         picture.width,
                         picture.height,
                         picture.width,
                         PixelFormat::kGrey8,
                         255};
    write_png(std::filesystem::path(folder) / (file + ".png"), view);
  };
}

// What the flight extractor sees between image and dots.
void show_own_stages(const ImageView& image, const ExtractorParameters& parameters,
                     const StageObserver& observer) {
  observer("original", grey_image(image));
  BackgroundMap background(image.width, image.height);
  background.build(image, parameters.polarity == DotPolarity::kDark);
  DetectionFilter filter(image.width, image.height);
  filter.start(image, parameters.polarity == DotPolarity::kDark, background, parameters.threshold);
  GreyImage level(image.width, image.height), noise = level, over = level;
  for (int v = 0; v < image.height; ++v) {
    const bool any = v > 0 && v < image.height - 1 && filter.row(v);
    for (int u = 0; u < image.width; ++u) {
      level.at(u, v) = background.level(static_cast<float>(u), static_cast<float>(v));
      noise.at(u, v) = background.noise(static_cast<float>(u), static_cast<float>(v));
      if (any) over.at(u, v) = static_cast<float>((filter.word(u / DetectionFilter::kWord) >> (u % 64)) & 1U);
    }
  }
  observer("background", level);
  observer("noise", noise);
  observer("over the threshold", over);
}

std::vector<Mark> own_dots(const ImageView& image, const DotsArguments& arguments) {
  DotExtractor extractor(image.width, image.height);
  const auto list = std::make_unique<DotList>();
  extractor.extract(image, arguments.extractor, *list);
  std::printf("u_px,v_px,sigma_u_px,sigma_v_px,flux_levels,snr,width_px,area_px,flags\n");
  std::vector<Mark> marks;
  for (const Dot& dot : list->dots) {
    std::printf("%.4f,%.4f,%.4f,%.4f,%.1f,%.1f,%.2f,%d,%d\n", dot.pixel.x(), dot.pixel.y(),
                std::sqrt(dot.covariance(0, 0)), std::sqrt(dot.covariance(1, 1)),
                static_cast<double>(dot.flux), static_cast<double>(dot.snr),
                static_cast<double>(dot.sigma_major), dot.area, dot.flags);
    marks.push_back({dot.pixel, MarkKind::kPaired, {}, 0});
  }
  return marks;
}

ClassicalAlgorithm classical_algorithm(const std::string& name) {
  if (name == "mlas") return ClassicalAlgorithm::kMlas;
  return name == "small-target" ? ClassicalAlgorithm::kSmallTarget : ClassicalAlgorithm::kStars;
}

std::vector<Mark> classical_dots(const ImageView& image, const DotsArguments& arguments,
                                 const StageObserver& observer) {
  ClassicalPipelines pipelines(image.width, image.height, arguments.classical);
  take_levels(image, false, pipelines.original());
  if (!arguments.black_frame.empty()) {
    const GreyImage black = grey_image(read_image(arguments.black_frame).view());
    if (black.width != image.width || black.height != image.height)
      throw InputError(arguments.black_frame, 0, "size",
                       format("%d x %d pixels, as the image", image.width, image.height),
                       format("%d x %d", black.width, black.height));
    subtract(black, pipelines.original());
  }
  std::printf("u_px,v_px,area_px\n");
  std::vector<Mark> marks;
  for (const ClassicalDot& dot : pipelines.run(classical_algorithm(arguments.algorithm), &observer)) {
    std::printf("%.3f,%.3f,%d\n", dot.pixel.x(), dot.pixel.y(), dot.area);
    marks.push_back({dot.pixel, MarkKind::kPaired, {}, 0});
  }
  if (pipelines.dropped() > 0)
    std::fprintf(stderr, "%u more, of less light, are not listed\n", pipelines.dropped());
  return marks;
}

int dots(DotsArguments arguments) {
  const auto odd = [](int window, const char* option) {
    if (window % 2 == 0)
      throw InputError("arguments", 0, option, "an odd number of pixels", format("%d", window));
  };
  odd(arguments.classical.window, "--window");
  if (!arguments.black_frame.empty() && arguments.algorithm != "stars")
    throw InputError("arguments", 0, "--black-frame", "--algorithm stars with it", arguments.algorithm);
  if (arguments.dark && arguments.algorithm != "omma")
    throw InputError("arguments", 0, "--dark", "--algorithm omma with it", arguments.algorithm);
  if (arguments.dark) arguments.extractor.polarity = DotPolarity::kDark;
  const Image image = read_image(arguments.image);
  ImageView view = image.view();
  if (arguments.bits > 0) view.white_level = static_cast<std::uint16_t>((1 << arguments.bits) - 1);
  const StageObserver observer = stage_writer(arguments.stages);
  if (arguments.algorithm == "omma" && observer) show_own_stages(view, arguments.extractor, observer);
  Annotation annotation;
  annotation.marks =
      arguments.algorithm == "omma" ? own_dots(view, arguments) : classical_dots(view, arguments, observer);
  std::fprintf(stderr, "%zu dots\n", annotation.marks.size());
  if (!arguments.annotated.empty()) {
    annotation.title = arguments.algorithm + ": " + std::to_string(annotation.marks.size()) + " dots";
    write_bytes(arguments.annotated, annotate(view, annotation).png());
  }
  return 0;
}

}  // namespace

void add_dots(CLI::App& app, CommandContext& context) {
  auto a = std::make_shared<DotsArguments>();
  CLI::App* command = app.add_subcommand("dots", "The dots of an image, by any pipeline, as a CSV table");
  command->add_option("image", a->image, "PNG, JPEG or FITS")->required();
  command->add_option("--algorithm", a->algorithm, "omma, mlas, small-target or stars")
      ->check(CLI::IsMember({"omma", "mlas", "small-target", "stars"}));
  command->add_option("--stages", a->stages, "Folder for a picture of every stage");
  command->add_option("--annotate", a->annotated, "Picture with a circle on every dot");
  command->add_option("--bits", a->bits, "Bits of a pixel, where the file has room for more")
      ->check(CLI::Range(1, 16));
  command->add_option("--threshold", a->extractor.threshold, "omma: standard deviations")
      ->check(CLI::Range(1.0F, 100.0F));
  command->add_option("--gain", a->extractor.gain, "omma: electrons per grey level")
      ->check(CLI::PositiveNumber);
  command->add_flag("--dark", a->dark, "omma: dots darker than the background");
  command
      ->add_option("--window", a->classical.window, "Others: side of the local threshold's window [px], odd")
      ->check(CLI::Range(3, 501));
  command
      ->add_option("--deviations", a->classical.deviations, "Others: local threshold [standard deviations]")
      ->check(CLI::Range(-5.0, 50.0));
  command->add_option("--least-area", a->classical.least_area, "Others: smaller objects are removed [px]")
      ->check(CLI::Range(1, 100000));
  command->add_option("--black-frame", a->black_frame, "stars: mean image with the lens covered");
  command->callback([a, &context] { context.exit_code = dots(*a); });
}

}  // namespace omma::ground
