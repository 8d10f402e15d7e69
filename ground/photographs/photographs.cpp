#include "ground/photographs/photographs.hpp"

#include <cmath>
#include <filesystem>

#include "components/geometry/lens_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"

namespace omma::ground {
namespace {

Photographs rig_photographs(const PhotographArguments& arguments) {
  Photographs set;
  set.rig = read_rig_file(arguments.rig);
  set.images.resize(set.rig.cameras.size());
  for (const std::string& argument : arguments.images) {
    const CameraFile given = camera_file(argument, set.rig, arguments.rig);
    const RigCamera& camera = set.rig.cameras[given.camera];
    Image& image = set.images[given.camera];
    if (image.width > 0) {
      throw InputError(argument, 0, "camera", "one image for each camera",
                       std::string(camera.name.view()) + " again");
    }
    image = read_image(given.file);
    require_size(given.file, image, camera.lens);
  }
  return set;
}

Photographs single_photograph(const PhotographArguments& arguments, std::size_t index) {
  const std::string& file = arguments.images[index];
  Photographs set;
  set.images.push_back(read_image(file));
  const Image& image = set.images.back();
  RigCamera camera;
  camera.name = Name("cam0");
  if (arguments.lenses.empty()) {
    camera.lens = Lens::pinhole(image.width, image.height, arguments.fov_deg * M_PI / 180);
  } else {
    camera.lens = read_lens_file(arguments.lenses[arguments.lenses.size() == 1 ? 0 : index]);
    require_size(file, image, camera.lens);
  }
  set.rig.name = camera.name;
  set.rig.cameras.push_back(camera);
  return set;
}

}  // namespace

std::vector<ImageView> Photographs::views() const {
  std::vector<ImageView> views;
  for (const Image& image : images) views.push_back(image.width > 0 ? image.view() : ImageView{});
  return views;
}

void add_photograph_options(CLI::App& command, PhotographArguments& arguments) {
  command.add_option("images", arguments.images, "IMAGE..., or CAMERA=IMAGE... with --rig (PNG, JPEG, FITS)")
      ->required();
  command.add_option("--lens", arguments.lenses,
                     "lens file (OCamCalib, Bouguet, Kalibr): one for all images, or one each");
  command.add_option("--rig", arguments.rig, "rig file: the images are one frame set, solved jointly");
  command.add_option("--fov", arguments.fov_deg, "horizontal field of view of a pinhole camera [degrees]")
      ->check(CLI::Range(0.1, 170.0));
}

void check(const PhotographArguments& arguments) {
  const bool has_lens = !arguments.lenses.empty();
  const int given = (has_lens ? 1 : 0) + (arguments.rig.empty() ? 0 : 1) + (arguments.fov_deg > 0 ? 1 : 0);
  if (given != 1) {
    throw InputError("arguments", 0, "lens", "one of --lens, --rig and --fov",
                     given == 0 ? "none" : std::to_string(given) + " of them");
  }
  if (has_lens && arguments.lenses.size() != 1 && arguments.lenses.size() != arguments.images.size()) {
    throw InputError("arguments", 0, "--lens", "one lens file, or one for each image",
                     std::to_string(arguments.lenses.size()) + " for " +
                         std::to_string(arguments.images.size()) + " images");
  }
}

std::size_t set_count(const PhotographArguments& arguments) {
  return arguments.rig.empty() ? arguments.images.size() : 1;
}

Photographs read_photographs(const PhotographArguments& arguments, std::size_t set) {
  return arguments.rig.empty() ? single_photograph(arguments, set) : rig_photographs(arguments);
}

CameraFile camera_file(const std::string& argument, const Rig& rig, const std::string& rig_file) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos) {
    throw InputError(argument, 0, "image", "CAMERA=FILE when a rig is given", "no camera name");
  }
  const std::string name = argument.substr(0, equals);
  std::size_t camera = 0;
  while (camera < rig.cameras.size() && rig.cameras[camera].name.view() != name) ++camera;
  if (camera == rig.cameras.size())
    throw InputError(argument, 0, "camera", "a camera of the rig " + rig_file, name);
  return {camera, argument.substr(equals + 1)};
}

void require_size(const std::string& file, const Image& image, const Lens& lens) {
  if (image.width == lens.width() && image.height == lens.height()) return;
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw InputError(file, 0, "image size", size(lens.width(), lens.height()) + " as the lens file says",
                   size(image.width, image.height));
}

std::string name_with_suffix(const std::string& file, const std::string& suffix) {
  const std::filesystem::path path(file);
  return (path.parent_path() / (path.stem().string() + "_" + suffix + path.extension().string())).string();
}

std::string annotated_name(const PhotographArguments& arguments, const Photographs& photographs,
                           const std::string& file, std::size_t set, std::size_t camera) {
  if (photographs.rig.cameras.size() > 1)
    return name_with_suffix(file, std::string(photographs.rig.cameras[camera].name.view()));
  return set_count(arguments) > 1 ? name_with_suffix(file, std::to_string(set)) : file;
}

}  // namespace omma::ground
