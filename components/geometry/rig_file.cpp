#include "components/geometry/rig_file.hpp"

#include <cmath>
#include <sstream>

#include "components/geometry/lens_file.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {
namespace {

constexpr double kQuaternionTolerance = 1e-3;

Name name_of(const TomlTable& table) {
  const std::string text = table.text("name");
  if (text.empty()) throw table.error("name", "a name", "an empty one");
  if (text.size() > limits::kNameLength) {
    throw table.error("name",
                      "at most " + std::to_string(limits::kNameLength) + " characters (limits::kNameLength)",
                      std::to_string(text.size()));
  }
  return Name(text);
}

Pose pose_of(const TomlTable& table) {
  const auto q = table.numbers("quaternion_xyzw", 4);
  const auto t = table.numbers("translation_m", 3);
  table.refuse_unknown_keys();
  Pose pose;
  pose.rotation = Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
  pose.translation = Eigen::Vector3d(t[0], t[1], t[2]);
  const double length = pose.rotation.norm();
  if (!(std::abs(length - 1) <= kQuaternionTolerance)) {
    std::ostringstream found;
    found << "length " << length;
    throw table.error("quaternion_xyzw", "a quaternion of length 1", found.str());
  }
  pose.rotation.normalize();
  return pose;
}

}  // namespace

Rig read_rig_file(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::read(file);
  Rig rig;
  rig.name = name_of(root);
  const auto cameras = root.tables("camera");
  root.refuse_unknown_keys();
  if (cameras.size() > static_cast<std::size_t>(limits::kCameras)) {
    throw cameras[limits::kCameras].error(
        "name", "at most " + std::to_string(limits::kCameras) + " cameras (limits::kCameras)",
        std::to_string(cameras.size()));
  }
  for (const TomlTable& table : cameras) {
    RigCamera camera;
    camera.name = name_of(table);
    for (const RigCamera& other : rig.cameras) {
      if (other.name == camera.name) {
        throw table.error("name", "a name no other camera has", "\"" + table.text("name") + "\" again");
      }
    }
    camera.rig_from_camera = pose_of(table.table("rig_from_camera"));
    const std::string lens = table.path("lens").string();
    table.refuse_unknown_keys();
    camera.lens = read_lens_file(lens);
    rig.cameras.push_back(camera);
  }
  return rig;
}

}  // namespace omma
