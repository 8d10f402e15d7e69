#include "ground/experiment/rig_pictures.hpp"

#include <iterator>

#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/report/report_pictures.hpp"

namespace omma::ground {

std::vector<RigPicture> rig_pictures(const ChainRun& run, const std::filesystem::path& frames) {
  std::vector<RigPicture> pictures;
  if (run.log.dots.empty()) return pictures;
  const auto middle = std::next(run.log.dots.begin(), static_cast<std::ptrdiff_t>(run.log.dots.size() / 2));
  const auto& [frame, cameras] = *middle;
  for (std::size_t c = 0; c < run.mission.rig.cameras.size() && c < cameras.size(); ++c) {
    const std::string camera(run.mission.rig.cameras[c].name.view());
    const std::filesystem::path file =
        frames / camera / (camera + format("_%06llu.png", static_cast<unsigned long long>(frame)));
    pictures.push_back({camera, camera_picture(file, run.mission, cameras[c], camera, frame).png()});
  }
  return pictures;
}

}  // namespace omma::ground
