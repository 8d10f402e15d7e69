#include "ground/calibrate/sky_files.hpp"

#include <filesystem>

#include "ground/calibrate/rig_text.hpp"
#include "ground/calibrate/sky_report.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {

void write_sky_calibration(const SkyCalibration& calibration, const std::string& output, bool with_rig) {
  make_folder(output, "--output");
  const std::filesystem::path folder = output;
  std::vector<std::string> files;
  for (const RigCamera& camera : calibration.rig.cameras) {
    files.push_back(camera.name.c_str() +
                    std::string(camera.lens.model() == LensModel::kOcam ? ".txt" : ".yaml"));
    write_text_file((folder / files.back()).string(), lens_file_text(camera.lens));
  }
  if (with_rig)
    write_text_file((folder / "rig.toml").string(),
                    rig_file_text(calibration.rig, files, "Calibrated on the stars by omma calibrate sky."));
  write_text_file((folder / "calibration.json").string(), sky_report_json(calibration));
  write_page((folder / "calibration.html").string(), sky_report_page(calibration));
}

}  // namespace omma::ground
