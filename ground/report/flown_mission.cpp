#include "ground/report/flown_mission.hpp"

#include <algorithm>

#include "components/catalogue/observer.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma::ground {

FlownMission read_flown_mission(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::read(file);
  FlownMission mission;
  mission.spacecraft = root.text("spacecraft");
  mission.frame_rate_hz = root.number("frame_rate_hz", {0.01, 1000});
  if (root.has("epoch")) mission.julian_date_utc = parse_utc(root.text("epoch"));
  mission.rig = read_rig_file(root.path("rig"));

  const ExtractorParameters usual;
  mission.least_snr.assign(mission.rig.cameras.size(), std::max(usual.threshold, usual.min_snr));
  for (const TomlTable& table : root.tables_if("camera")) {
    const std::string name = table.text("name");
    const auto extractor = table.table_if("extractor");
    for (std::size_t c = 0; extractor && c < mission.rig.cameras.size(); ++c) {
      if (mission.rig.cameras[c].name.view() != name) continue;
      mission.least_snr[c] =
          std::max<double>(extractor->number("threshold", {1, 100}, usual.threshold), usual.min_snr);
    }
  }
  for (const TomlTable& table : root.tables_if("body")) {
    TargetBody body = read_target_file(table.path("targets"));
    const std::string name = table.text("name");
    if (name.empty() || name.size() > limits::kNameLength)
      throw table.error("name", "1 to " + std::to_string(limits::kNameLength) + " characters", name);
    body.name = Name(name);
    mission.bodies.push_back(body);
  }
  return mission;
}

}  // namespace omma::ground
