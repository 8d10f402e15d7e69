// Blinking codes: their distances, and lights told apart through lost frames among steady lights and clutter.
#include "components/tracker/blink_codes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <memory>

#include "components/tracker/blink_tracks.hpp"
#include "tests/bench/blink_problem.hpp"

namespace omma {
namespace {

TEST(BlinkCodes, DifferAtEveryPhaseAndAreNeverDarkTwiceInARow) {
  const BlinkCodes codes = make_blink_codes(16, 20, 4);
  ASSERT_EQ(codes.words.size(), 16U);
  for (std::size_t a = 0; a < codes.words.size(); ++a) {
    for (int by = 0; by < 20; ++by) {
      for (std::size_t b = 0; b < codes.words.size(); ++b) {
        if (a == b && by == 0) continue;
        EXPECT_GE(std::popcount(codes.words[a] ^ turned(codes.words[b], by, 20)), 4);
      }
    }
    const std::uint32_t dark = ~codes.words[a] & 0xfffffU;
    EXPECT_EQ(dark & turned(dark, 1, 20), 0U);
  }
}

TEST(BlinkCodes, OfImpossibleLengthsAreRefused) {
  EXPECT_THROW(make_blink_codes(4, 4, 2), std::invalid_argument);
  EXPECT_THROW(make_blink_codes(4, 33, 2), std::invalid_argument);
  EXPECT_THROW(BlinkDecoder(BlinkCodes{}), std::invalid_argument);
}

struct Score {
  int right = 0, wrong = 0, open = 0;
};

Score score(const BlinkProblemOptions& options, int frames, int trials) {
  const BlinkDecoder decoder(make_blink_codes(16, 20, 4));
  const auto tracks = std::make_unique<BlinkTracks>();
  Score score;
  for (int trial = 0; trial < trials; ++trial) {
    *tracks = BlinkTracks();
    BlinkScene scene(decoder.codes(), options, 100 + static_cast<std::uint64_t>(trial));
    BlinkFrame frame;
    for (int i = 0; i < frames; ++i) {
      frame = scene.next();
      tracks->step(frame.number, frame.dots);
    }
    std::vector<BlinkHistory> histories;
    for (const BlinkTrack& track : tracks->tracks()) histories.push_back(track.history);
    std::vector<BlinkIdentity> identities(histories.size());
    decoder.decode(histories, identities);
    for (std::size_t t = 0; t < identities.size(); ++t) {
      const int dot = tracks->tracks()[t].dot;
      if (dot < 0) continue;
      const int truth = frame.light[static_cast<std::size_t>(dot)];
      score.right += identities[t].code >= 0 && identities[t].code == truth ? 1 : 0;
      score.wrong += identities[t].code >= 0 && identities[t].code != truth ? 1 : 0;
      score.open += identities[t].code < 0 && truth >= 0 ? 1 : 0;
    }
  }
  return score;
}

TEST(BlinkDecoder, TellsLightsApartThroughLostFramesAndClutter) {
  const Score found = score({}, 40, 30);
  EXPECT_GE(found.right, 97 * (found.right + found.open) / 100);
  EXPECT_EQ(found.wrong, 0);
}

TEST(BlinkDecoder, SaysNothingOfSteadyLights) {
  const BlinkDecoder decoder(make_blink_codes(8, 20, 4));
  const std::vector<BlinkHistory> steady(5, {0xffffffff, 0xffffffff});
  std::vector<BlinkIdentity> identities(5);
  decoder.decode(steady, identities);
  for (const BlinkIdentity& identity : identities) EXPECT_EQ(identity.code, -1);
  EXPECT_EQ(decoder.decode({}, {}), -1);
}

TEST(BlinkDecoder, NeedsMoreThanAGlance) {
  const Score glance = score({}, 3, 10);
  EXPECT_EQ(glance.wrong, 0);
  EXPECT_GT(glance.open, 0);
}

TEST(BlinkTracks, LostFramesAreUnknownAndNotDark) {
  BlinkTracks tracks;
  const std::vector<Eigen::Vector2d> here{{100, 100}};
  tracks.step(10, here);
  tracks.step(11, here);
  tracks.step(14, here);
  ASSERT_EQ(tracks.tracks().size(), 1U);
  EXPECT_EQ(tracks.tracks()[0].history.known, 0b11001U);
  EXPECT_EQ(tracks.tracks()[0].history.lit, 0b11001U);
  tracks.step(15, {});
  EXPECT_EQ(tracks.tracks()[0].history.known, 0b110011U);
  EXPECT_EQ(tracks.tracks()[0].history.lit, 0b110010U);
  tracks.step(3, here);  // time that runs backwards is another recording
  EXPECT_EQ(tracks.tracks()[0].history.known, 1U);
}

}  // namespace
}  // namespace omma
