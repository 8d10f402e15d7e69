#include "ground/report/truth.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma::ground {
namespace {

using Json = nlohmann::json;

/// One JSON object of the file, and where it stands, for messages.
class Record {
 public:
  Record(const Json& json, const std::string& file, int line, std::string prefix)
      : json_(json), file_(file), line_(line), prefix_(std::move(prefix)) {
    if (!json.is_object()) fail("", "a JSON object", json);
  }

  double number(const char* field) const {
    const Json& value = member(field, "a number");
    return finite(value, field);
  }
  std::int64_t integer(const char* field) const {
    const Json& value = member(field, "a whole number");
    if (!value.is_number_integer()) fail(field, "a whole number", value);
    return value.get<std::int64_t>();
  }
  std::string text(const char* field) const {
    const Json& value = member(field, "a text");
    if (!value.is_string()) fail(field, "a text", value);
    return value.get<std::string>();
  }
  bool has(const char* field) const { return json_.contains(field); }
  template <int kCount>
  Eigen::Matrix<double, kCount, 1> numbers(const char* field) const {
    const std::string expected = std::to_string(kCount) + " numbers";
    const Json& value = member(field, expected);
    if (!value.is_array() || value.size() != kCount) fail(field, expected, value);
    Eigen::Matrix<double, kCount, 1> vector;
    for (int i = 0; i < kCount; ++i) vector[i] = finite(value[static_cast<std::size_t>(i)], field);
    return vector;
  }
  Eigen::Quaterniond rotation(const char* field) const {
    const Eigen::Vector4d q = numbers<4>(field);
    if (std::abs(q.norm() - 1) > 1e-6) fail(field, "a quaternion of length 1", member(field, ""));
    return Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
  }
  Record object(const char* field) const {
    return {member(field, "a JSON object"), file_, line_, prefix_ + field + "."};
  }
  template <class Take>
  void each(const char* field, Take&& take) const {
    const Json& list = member(field, "a list");
    if (!list.is_array()) fail(field, "a list", list);
    for (std::size_t i = 0; i < list.size(); ++i)
      take(Record(list[i], file_, line_, prefix_ + field + "[" + std::to_string(i) + "]."));
  }
  [[noreturn]] void fail(const std::string& field, const std::string& expected, const Json& found) const {
    throw InputError(file_, line_, field.empty() ? prefix_ + "record" : prefix_ + field, expected,
                     excerpt(found.dump()));
  }

 private:
  const Json& member(const char* field, const std::string& expected) const {
    const auto at = json_.find(field);
    if (at == json_.end()) throw InputError(file_, line_, prefix_ + field, expected, "no such field");
    return *at;
  }
  double finite(const Json& value, const char* field) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) fail(field, "a number", value);
    return value.get<double>();
  }

  const Json& json_;
  const std::string& file_;
  int line_;
  std::string prefix_;
};

TruthSpot read_spot(const Record& record, int cameras) {
  TruthSpot spot;
  const std::int64_t camera = record.integer("camera");
  if (camera < 0 || camera >= cameras)
    record.fail("camera", "a camera of the rig, 0 to " + std::to_string(cameras - 1), camera);
  spot.camera = static_cast<int>(camera);
  const std::string kind = record.text("kind");
  if (kind == "star") {
    spot.kind = TruthSpot::Kind::kStar;
    spot.hr = static_cast<std::uint16_t>(record.integer("hr"));
  } else if (kind == "target") {
    spot.kind = TruthSpot::Kind::kTarget;
    spot.body = record.text("body");
    spot.id = record.text("id");
  } else if (kind == "planet") {
    spot.kind = TruthSpot::Kind::kPlanet;
    spot.id = record.text("name");
  } else if (kind == "moon") {
    spot.kind = TruthSpot::Kind::kMoon;
  } else if (kind == "sun") {
    spot.kind = TruthSpot::Kind::kSun;
  } else {
    record.fail("kind", "star, target, planet, moon or sun", kind);
  }
  spot.pixel = {record.number("u"), record.number("v")};
  spot.snr = record.number("snr");
  const Eigen::Vector3d abc = record.numbers<3>("information");
  spot.information << abc[0], abc[1], abc[1], abc[2];
  return spot;
}

void read_exposures(const Record& record, int cameras, TruthFrame& frame) {
  record.each("exposures", [&](const Record& exposure) {
    TruthExposure& one = frame.exposures.emplace_back();
    one.turn = exposure.numbers<3>("turn_rad");
    exposure.each("bodies", [&](const Record& body) {
      one.bodies.emplace_back() << body.numbers<3>("turn_rad"), body.numbers<3>("move_m");
    });
    if (one.bodies.size() != frame.bodies.size())
      exposure.fail("bodies", "one for each body of the frame", one.bodies.size());
  });
  if (frame.exposures.size() != static_cast<std::size_t>(cameras))
    record.fail("exposures", "one for each camera", frame.exposures.size());
}

TruthFrame read_frame(const Record& record, int cameras) {
  TruthFrame frame;
  const std::int64_t number = record.integer("frame");
  if (number < 0) record.fail("frame", "a number from 0", number);
  frame.frame = static_cast<std::uint64_t>(number);
  frame.time_ns = record.integer("time_ns");
  frame.utc = record.text("utc");
  frame.rig_from_j2000 = record.rotation("rig_from_j2000");
  frame.rate = record.numbers<3>("rate_rig");
  record.each("bodies", [&](const Record& body) {
    const Record pose = body.object("rig_from_body");
    frame.bodies.push_back(
        {body.text("name"), {pose.rotation("quaternion_xyzw"), pose.numbers<3>("translation_m")}});
  });
  if (record.has("exposures")) read_exposures(record, cameras, frame);
  record.each("spots", [&](const Record& spot) { frame.spots.push_back(read_spot(spot, cameras)); });
  return frame;
}

}  // namespace

std::vector<TruthFrame> read_truth(const std::filesystem::path& file, int cameras) {
  const std::string name = file.string();
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(name, 0, "file", "the truth of a simulated recording", "no readable file");
  std::vector<TruthFrame> frames;
  int line_number = 0;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded())
      throw InputError(name, line_number, "line", "one JSON object, whole", excerpt(line));
    const Record record(json, name, line_number, "");
    frames.push_back(read_frame(record, cameras));
    if (frames.size() > 1 && frames.back().frame <= frames[frames.size() - 2].frame)
      record.fail("frame", "a number above the line before", frames.back().frame);
  }
  if (frames.empty()) throw InputError(name, 0, "file", "one frame set a line", "an empty file");
  return frames;
}

}  // namespace omma::ground
