#include "ground/blackframe/blackframe.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "components/sensor/black_frame_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

struct BlackFrameArguments {
  std::vector<std::string> darks;
  std::string output;
  HotPixelRule rule;
};

// Root mean square of the pixels' means about the typical one, hot pixels left out: what the frame takes
// away.
double pattern(const BlackFrame& black) {
  const auto typical = static_cast<double>(black.typical_mean());
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < black.mean.size(); ++i) {
    const int u = static_cast<int>(i) % black.width;
    const int v = static_cast<int>(i) / black.width;
    if (black.hot.at(u, v)) continue;
    sum += (static_cast<double>(black.mean[i]) - typical) * (static_cast<double>(black.mean[i]) - typical);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

int blackframe(const BlackFrameArguments& arguments) {
  BlackFrameBuilder builder;
  int width = 0, height = 0;
  for (const std::string& file : arguments.darks) {
    const Image dark = read_image(file);
    if (builder.frames() == 0) {
      width = dark.width;
      height = dark.height;
    }
    if (!builder.add(dark.view()))
      throw InputError(file, 0, "size", format("%d x %d pixels, as the first dark frame", width, height),
                       format("%d x %d", dark.width, dark.height));
  }
  HotPixelCounts counts;
  const BlackFrame black = builder.build(arguments.rule, counts);
  write_black_frame(arguments.output, black);
  std::printf("dark frames          %d of %d x %d pixels\n", black.frames, black.width, black.height);
  std::printf("typical mean         %.2f grey levels\n", static_cast<double>(black.typical_mean()));
  std::printf("fixed pattern        %.2f grey levels rms\n", pattern(black));
  if (black.frames > 1) {
    std::printf("typical noise        %.2f grey levels\n", static_cast<double>(black.typical_noise()));
  } else {
    std::printf("typical noise        unknown of a single frame\n");
  }
  std::printf("hot pixels           %d (%d bright, %d noisy)\n", counts.all, counts.bright, counts.noisy);
  return 0;
}

}  // namespace

void add_blackframe(CLI::App& app, CommandContext& context) {
  auto a = std::make_shared<BlackFrameArguments>();
  CLI::App* command = app.add_subcommand(
      "blackframe", "Frames taken with the lens covered -> black frame with its hot pixels");
  command->add_option("darks", a->darks, "PNG, JPEG or FITS, all of one size")->required();
  command->add_option("--output", a->output, "FITS file to write")->required();
  command
      ->add_option("--above", a->rule.above,
                   "Hot: mean so many robust standard deviations over the typical one")
      ->check(CLI::PositiveNumber);
  command->add_option("--noisier", a->rule.noisier, "Hot: noise above so many times the typical one")
      ->check(CLI::PositiveNumber);
  command->callback([a, &context] { context.exit_code = blackframe(*a); });
}

}  // namespace omma::ground
