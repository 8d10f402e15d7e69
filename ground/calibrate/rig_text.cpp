#include "ground/calibrate/rig_text.hpp"

#include "ground/format.hpp"

namespace omma::ground {

std::string rig_file_text(const Rig& rig, const std::vector<std::string>& lens_files,
                          const std::string& made_by) {
  std::string text = "# " + made_by + "\nname = \"" + std::string(rig.name.view()) + "\"\n";
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const Pose& pose = rig.cameras[c].rig_from_camera;
    const Eigen::Quaterniond& q = pose.rotation;
    text += format("\n[[camera]]\nname = \"%s\"\nlens = \"%s\"\n", rig.cameras[c].name.c_str(),
                   lens_files[c].c_str());
    text += format(
        "rig_from_camera = { quaternion_xyzw = [%.12f, %.12f, %.12f, %.12f], translation_m = [%.9g, %.9g, "
        "%.9g] }\n",
        q.x(), q.y(), q.z(), q.w(), pose.translation.x(), pose.translation.y(), pose.translation.z());
  }
  return text;
}

}  // namespace omma::ground
