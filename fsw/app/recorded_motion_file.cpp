#include "fsw/app/recorded_motion_file.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "components/motion/motion_files.hpp"
#include "components/telemetry/cdr.hpp"
#include "components/telemetry/mcap_reader.hpp"
#include "components/telemetry/topics.hpp"
#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

/// The lines of IDL that a sample of the motion is made of.
std::string_view motion_in(std::string_view idl) {
  const std::size_t begin = idl.find("enum MotionMode");
  const std::size_t end = idl.find("};", idl.find("struct Motion {", begin));
  return begin == std::string_view::npos || end == std::string_view::npos ? std::string_view{}
                                                                          : idl.substr(begin, end - begin);
}

std::string names_of(const std::vector<GimbalAxis>& gimbal) {
  std::string names;
  for (const GimbalAxis& axis : gimbal) names += (names.empty() ? "" : ", ") + std::string(axis.name.view());
  return names;
}

AxisCommand command_of(const omma_AxisCommand& told) {
  AxisCommand command;
  command.state.angle = told.angle_rad;
  command.state.speed = command.goal.speed = told.speed_rad_s;
  command.goal.angle = told.goal_rad;
  command.pulse = told.pulse_quarter_us;
  return command;
}

RecordedMotionSample sample_of(const omma_Motion& told, const std::string& file,
                               const std::vector<GimbalAxis>& gimbal) {
  RecordedMotionSample sample;
  sample.frame = told.frame;
  MotionReport& report = sample.report;
  report.valid = told.valid;
  report.mode = static_cast<MotionMode>(told.mode);
  report.trajectory_time = told.trajectory_time_s;
  report.late_ticks = told.late_ticks;
  report.refused_commands = told.refused_commands;
  report.board_lost = told.board_lost;
  const omma_AxisCommand* const begin = told.axes._buffer;
  const omma_AxisCommand* const end = begin + told.axes._length;
  for (const GimbalAxis& axis : gimbal) {
    const auto* const found =
        std::find_if(begin, end, [&](const omma_AxisCommand& one) { return axis.name.view() == one.name; });
    if (found == end || told.axes._length != gimbal.size())
      throw InputError(file, 0, "axes", "those of the gimbal, " + names_of(gimbal),
                       std::to_string(told.axes._length) + " without " + std::string(axis.name.view()));
    report.axes.push_back(command_of(*found));
  }
  return sample;
}

RecordedMotion read_mcap(const std::string& file, const std::vector<GimbalAxis>& gimbal) {
  mcap::Reader reader(file);
  const auto wanted = [&](const mcap::Channel& channel) {
    if (!channel.topic.starts_with("omma/") ||
        telemetry::find_topic(channel.topic) != telemetry::TopicId::kMotion)
      return false;
    const auto schema = reader.schemas().find(channel.schema);
    if (schema == reader.schemas().end() ||
        motion_in(schema->second.text) != motion_in(telemetry::idl_text()))
      throw InputError(file, 0, channel.topic, "the motion as this program knows it",
                       "another version of it (omma export makes a table, which may be played back)");
    return true;
  };
  std::vector<RecordedMotionSample> samples;
  telemetry::CdrReader decoder(telemetry::TopicId::kMotion);
  reader.for_each_message(wanted, [&](const mcap::MessageView& message) {
    const auto* const told = decoder.read_as<omma_Motion>(message.data);
    if (told == nullptr) throw InputError(file, 0, "motion", "whole samples", "one that is not");
    samples.push_back(sample_of(*told, file, gimbal));
    return true;
  });
  if (samples.empty())
    throw InputError(file, 0, "recording", "the topic motion of a flight that moved a gimbal",
                     reader.damage().empty() ? "none" : reader.damage());
  std::stable_sort(samples.begin(), samples.end(),
                   [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return RecordedMotion(std::move(samples));
}

}  // namespace

RecordedMotion read_recorded_motion(const std::filesystem::path& file,
                                    const std::vector<GimbalAxis>& gimbal) {
  if (file.extension() == ".mcap") return read_mcap(file.string(), gimbal);
  if (file.extension() == ".csv") return {gimbal, read_key_points(file, gimbal)};
  throw InputError(file.string(), 0, "recording", "a name that ends in .mcap or .csv",
                   file.extension().string());
}

}  // namespace omma
