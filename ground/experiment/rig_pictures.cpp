#include "ground/experiment/rig_pictures.hpp"

#include <iterator>

#include "ground/report/report_pictures.hpp"
#include "hal/recorded/recorded_camera.hpp"

namespace omma::ground {

std::vector<RigPicture> rig_pictures(const ChainRun& run) {
  std::vector<RigPicture> pictures;
  if (run.log.dots.empty()) return pictures;
  const auto middle = std::next(run.log.dots.begin(), static_cast<std::ptrdiff_t>(run.log.dots.size() / 2));
  const auto& [frame, cameras] = *middle;
  for (std::size_t c = 0; c < run.mission.rig.cameras.size() && c < cameras.size(); ++c) {
    const std::string camera(run.mission.rig.cameras[c].name.view());
    for (const FrameFile& file : find_frame_files(run.frames / camera, camera)) {
      if (file.number == frame)
        pictures.push_back({camera, camera_picture(file.path, run.mission, cameras[c], camera, frame).png()});
    }
  }
  return pictures;
}

}  // namespace omma::ground
