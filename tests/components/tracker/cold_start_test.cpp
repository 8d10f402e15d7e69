// Cold starts of tracker, stars and a card together: what is in the way of one is out of it once the other is
// found.
#include <gtest/gtest.h>

#include <memory>

#include "components/catalogue/target_file.hpp"
#include "components/tracker/tracker.hpp"
#include "tests/bench/cold_frame.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

/// Sky and card found in the first frame set, of so many.
std::pair<int, int> found_at_once(const ColdFrameOptions& options, std::span<const std::uint64_t> seeds) {
  const Rig rig = equidistant_rig(1, 187);
  const auto catalogue = std::make_unique<StarCatalogue>(
      Observer{}, StarCatalogueParameters{6.5F, 2 * rig.cameras[0].lens.pixel_angle()});
  const std::vector<TargetBody> bodies{
      read_target_file(std::string(OMMA_SOURCE_DIR) + "/config/targets/docking_card.tsv")};
  TrackerParameters parameters;
  parameters.floor_px = 0;
  const auto tracker = std::make_unique<Tracker>(parameters, rig, *catalogue, bodies);
  const auto dots = std::make_unique<Out<DotLists>>();
  const auto attitude = std::make_unique<Out<AttitudeEstimate>>();
  const auto poses = std::make_unique<Out<PoseEstimates>>();
  tracker->dots.bind(*dots);
  tracker->attitude.bind(*attitude);
  tracker->poses.bind(*poses);
  int skies = 0, cards = 0;
  for (const std::uint64_t seed : seeds) {
    const ColdFrame truth = make_cold_frame(rig, catalogue->stars(), bodies[0], options, seed, **dots);
    tracker->step(Tick{});
    const SkyPairings& sky = tracker->pairings->sky;
    const BodyPairings& card = tracker->pairings->bodies[0];
    skies +=
        sky.state == TrackState::kAcquired && sky.rig_from_j2000.angularDistance(truth.rig_from_j2000) < 1e-3
            ? 1
            : 0;
    cards += card.state == TrackState::kAcquired &&
                     (card.rig_from_body.translation - truth.rig_from_body.translation).norm() < 0.02
                 ? 1
                 : 0;
  }
  return {skies, cards};
}

TEST(ColdStart, StarsAndCardAreFoundInOneFrameSet) {
  const std::vector<std::uint64_t> seeds{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(found_at_once({}, seeds), std::make_pair(10, 10));
}

TEST(ColdStart, TheSkyIsFoundAmongWhatTheCardLeavesWhereItHidesIt) {
  // Twenty-five bright targets and false dots as bright: with the card's dots in the way the search for the
  // sky ends at its limit in each of these.
  ColdFrameOptions options;
  options.false_fraction = 0.3;
  options.bright_false = true;
  const std::vector<std::uint64_t> seeds{22, 46, 68, 172, 265, 292, 339, 400};
  const auto [skies, cards] = found_at_once(options, seeds);
  EXPECT_EQ(cards, static_cast<int>(seeds.size()));
  EXPECT_EQ(skies, static_cast<int>(seeds.size()));
}

}  // namespace
}  // namespace omma
