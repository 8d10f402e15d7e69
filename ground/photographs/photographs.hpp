// The photographs a command is given: which images, through which lenses, of which rig. `omma solve`, `omma
// resect` and `omma calibrate sky` read them in the same way and refuse them in the same words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "components/geometry/rig.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {

/// One rig and the image of each of its cameras, in the order of the rig (empty: no image given).
struct Photographs {
  Rig rig;
  std::vector<Image> images;

  std::vector<ImageView> views() const;
};

struct PhotographArguments {
  std::vector<std::string> images;  ///< IMAGE, or CAMERA=IMAGE with a rig
  std::vector<std::string> lenses;
  std::string rig;
  double fov_deg = 0;  ///< horizontal, of an ideal pinhole; 0: not given
};

/// The positional images, --lens, --rig and --fov.
void add_photograph_options(CLI::App& command, PhotographArguments& arguments);

/// @throws InputError unless exactly one of lens, rig and field of view says how the images were taken
void check(const PhotographArguments& arguments);

/// With a rig the images are one set; without, each image is a set of its own.
std::size_t set_count(const PhotographArguments& arguments);
/// @throws InputError where an image, a lens or the rig cannot be used, or does not fit the others
Photographs read_photographs(const PhotographArguments& arguments, std::size_t set);

/// CAMERA=FILE, the camera one of the rig's.
struct CameraFile {
  std::size_t camera = 0;
  std::string file;
};
/// @param rig_file  only for the message
/// @throws InputError where there is no camera name, or none of this rig
CameraFile camera_file(const std::string& argument, const Rig& rig, const std::string& rig_file);

/// @throws InputError where the image is not as large as the lens says
void require_size(const std::string& file, const Image& image, const Lens& lens);

/// "out.png", "cam0" → "out_cam0.png".
std::string name_with_suffix(const std::string& file, const std::string& suffix);

/// Where the annotated picture of one camera goes: `file` itself where there is one picture only.
std::string annotated_name(const PhotographArguments& arguments, const Photographs& photographs,
                           const std::string& file, std::size_t set, std::size_t camera);

}  // namespace omma::ground
