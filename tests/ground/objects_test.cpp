// `omma objects` as an operator runs it.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "tests/ground/run_omma.hpp"
#include "tests/ground/sample_recording.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// An object that goes 0.1 degrees a second from right ascension 359.9, seen in every frame set but the
/// third.
void write_objects(const std::string& path) {
  telemetry::RecordingWriter recording(path, "testsat", false, {});
  telemetry::CdrWriter cdr;
  for (int i = 0; i < 11; ++i) {
    omma_UnknownObject object{};
    const double ra = (359.9 + 0.01 * i) * M_PI / 180;
    object.number = 3;
    object.motion = omma_MOTION_MOVING;
    object.seen = i != 2;
    object.sightings = static_cast<std::uint32_t>(i + 1);
    object.first_seen_ns = 5'000'000'000LL;
    object.last_seen_ns = 5'000'000'000LL + 100'000'000LL * i;
    object.cameras = i < 5 ? 1 : 4;
    object.bearing = {std::cos(ra), std::sin(ra), 0};
    object.direction = object.bearing;
    for (const int k : {0, 4, 8}) object.covariance_bearing_rad2[k] = 1e-8;
    omma_UnknownObjects sample{};
    sample.frame = static_cast<std::uint64_t>(i);
    sample.time_ns = 5'000'000'000LL + 100'000'000LL * i;
    sample.sample_number = static_cast<std::uint32_t>(i + 1);
    sample.valid = true;
    sample.objects = {1, 1, &object, false};
    recording.write(telemetry::TopicId::kUnknownObjects,
                    cdr.write(telemetry::TopicId::kUnknownObjects, &sample));
  }
  recording.close();
}

TEST(ObjectsCommand, TellsHowEachMoved) {
  const OperatorsFolder folder;
  write_objects((folder / "pass.mcap").string());
  const Told told = folder.omma("objects pass.mcap");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("     3  moving "));
  EXPECT_THAT(told.out, HasSubstr("0.100     6.000  0 2"));  // arc in degrees, arcminutes a second, cameras
}

TEST(ObjectsCommand, WritesATrackingDataMessage) {
  const OperatorsFolder folder;
  write_objects((folder / "pass.mcap").string());
  const Told told = folder.omma("objects pass.mcap --tdm pass.tdm --epoch 2026-04-02T23:59:59.5Z");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  const std::string message = folder.read("pass.tdm");
  EXPECT_THAT(message, HasSubstr("CCSDS_TDM_VERS = 2.0\nCREATION_DATE = 20"));
  EXPECT_THAT(message, HasSubstr("PARTICIPANT_1 = testsat\nPARTICIPANT_2 = OBJECT-00003\n"));
  EXPECT_THAT(message, HasSubstr("ANGLE_TYPE = RADEC\nREFERENCE_FRAME = EME2000\n"));
  EXPECT_THAT(message, HasSubstr("ANGLE_1 = 2026-04-02T23:59:59.500000 359.900000\n"));
  EXPECT_THAT(message, HasSubstr("ANGLE_1 = 2026-04-03T00:00:00.400000 359.990000\n"));
  EXPECT_THAT(message, HasSubstr("ANGLE_2 = 2026-04-03T00:00:00.400000 +0.000000\n"));
  EXPECT_THAT(message, Not(HasSubstr("23:59:59.700000"))) << "it was not seen then";
}

TEST(ObjectsCommand, SaysWhatIsMissing) {
  const OperatorsFolder folder;
  test::write_recording((folder / "other.mcap").string(), 3);
  EXPECT_THAT(folder.omma("objects other.mcap").err,
              HasSubstr("other.mcap: unknown_objects: expected a sample at least, found none"));
  EXPECT_THAT(folder.omma("objects other.mcap --tdm x.tdm").err,
              HasSubstr("--tdm: expected --epoch with it"));
  EXPECT_EQ(folder.omma("objects missing.mcap").exit_code, 2);
}

}  // namespace
}  // namespace omma
