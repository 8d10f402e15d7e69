// Kalibr camchain YAML (ethz-asl/kalibr wiki, "YAML formats"): one table per camera of a chain.
#include <yaml-cpp/yaml.h>

#include <vector>

#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

int line_of(const YAML::Node& node) {
  return node.Mark().is_null() ? 0 : node.Mark().line + 1;
}

std::string shown(const YAML::Node& node) {
  if (!node.IsDefined()) return "nothing";
  if (node.IsScalar()) return excerpt(node.Scalar());
  return node.IsSequence() ? "a list of " + std::to_string(node.size()) : "a table";
}

class KalibrCamera {
 public:
  KalibrCamera(const YAML::Node& node, std::string name, const std::string& file)
      : node_(node), name_(std::move(name)), file_(file) {}

  InputError error(const std::string& key, const std::string& expected) const {
    const YAML::Node value = node_[key];
    return {file_, line_of(value.IsDefined() ? value : node_), name_ + "." + key, expected, shown(value)};
  }

  std::string text(const std::string& key, const std::string& expected) const {
    const YAML::Node value = node_[key];
    if (!value.IsDefined() || !value.IsScalar()) throw error(key, expected);
    return value.Scalar();
  }

  std::vector<double> numbers(const std::string& key, std::size_t count) const {
    const std::string expected = "a list of " + std::to_string(count) + " finite numbers";
    const YAML::Node list = node_[key];
    if (!list.IsDefined() || !list.IsSequence() || list.size() != count) throw error(key, expected);
    std::vector<double> values;
    for (const YAML::Node& item : list) {
      const auto value = item.IsScalar() ? finite_number(item.Scalar()) : std::nullopt;
      if (!value)
        throw InputError(file_, line_of(item), name_ + "." + key, expected, shown(item) + " among them");
      values.push_back(*value);
    }
    return values;
  }

 private:
  YAML::Node node_;
  std::string name_;
  const std::string& file_;
};

YAML::Node camera_node(const YAML::Node& chain, const std::string& file, std::string& name) {
  std::string names;
  YAML::Node only;
  int cameras = 0;
  for (const auto& entry : chain) {
    if (!entry.first.IsScalar() || !entry.second.IsMap() || !entry.second["camera_model"].IsDefined())
      continue;
    names += (names.empty() ? "" : ", ") + entry.first.Scalar();
    ++cameras;
    if (name.empty() || entry.first.Scalar() == name) only.reset(entry.second);
    if (name == entry.first.Scalar()) return entry.second;
  }
  if (cameras == 0) throw InputError(file, 1, "camera", "a camera with camera_model", "none");
  if (!name.empty()) throw InputError(file, 0, "camera", "one of " + names, excerpt(name));
  if (cameras > 1) throw InputError(file, 0, "camera", "FILE#CAMERA with one of " + names, "no camera named");
  name = names;
  return only;
}

Lens lens_of(const KalibrCamera& camera) {
  const auto resolution = camera.numbers("resolution", 2);
  const int width = static_cast<int>(resolution[0]);
  const int height = static_cast<int>(resolution[1]);
  if (width < 1 || height < 1 || width > 1 << 16 || height > 1 << 16 || width != resolution[0] ||
      height != resolution[1]) {
    throw camera.error("resolution", "a width and a height in whole pixels");
  }
  const std::string models = "pinhole (with distortion_model radtan, equidistant or none)";
  if (camera.text("camera_model", models) != "pinhole") throw camera.error("camera_model", models);
  const auto k = camera.numbers("intrinsics", 4);
  if (!(k[0] > 0 && k[1] > 0)) throw camera.error("intrinsics", "focal lengths above zero");
  const Eigen::Vector2d focal(k[0], k[1]);
  const Eigen::Vector2d centre(k[2], k[3]);
  const std::string distortion = camera.text("distortion_model", "radtan, equidistant or none");
  if (distortion == "none") return Lens::caltech(width, height, focal, centre, 0, {});
  if (distortion != "radtan" && distortion != "equidistant") {
    throw camera.error("distortion_model", "radtan, equidistant or none");
  }
  const auto d = camera.numbers("distortion_coeffs", 4);
  if (distortion == "radtan")
    return Lens::caltech(width, height, focal, centre, 0, {d[0], d[1], d[2], d[3], 0});
  return Lens::kannala_brandt(width, height, focal, centre, {d[0], d[1], d[2], d[3]});
}

}  // namespace

Lens lens_from_kalibr(const std::string& text, const std::string& file, std::string_view camera) {
  try {
    const YAML::Node chain = YAML::Load(text);
    if (!chain.IsMap()) throw InputError(file, 1, "file", "a table of cameras", shown(chain));
    std::string name(camera);
    const YAML::Node node = camera_node(chain, file, name);
    return lens_of(KalibrCamera(node, name, file));
  } catch (const YAML::Exception& error) {
    throw InputError(file, error.mark.line + 1, "syntax", "YAML", error.msg);
  }
}

}  // namespace omma
