// Where the sequences of the samples keep their elements.
#include "components/telemetry/frame_report.hpp"

#include "components/telemetry/samples.hpp"

namespace omma::telemetry {
namespace {

// What leaves a component must fit what the IDL says, or it could not be sent.
static_assert(limits::kCameras <= omma_MAX_CAMERAS && limits::kDotsPerCamera <= omma_MAX_DOTS &&
              limits::kNameLength <= omma_MAX_NAME && limits::kComponents <= omma_MAX_COMPONENTS &&
              limits::kRateGroups <= omma_MAX_GROUPS && limits::kEventValues <= omma_MAX_EVENT_VALUES &&
              limits::kImageChunkBytes <= omma_MAX_IMAGE_BYTES &&
              limits::kParameterIds <= omma_MAX_PARAMETERS &&
              limits::kCommandArguments <= omma_MAX_ARGUMENTS && kFrameStages <= omma_MAX_STAGES);

template <class Sequence, class Storage>
void lead_to(Sequence& sequence, Storage* storage, std::size_t room) {
  sequence._maximum = static_cast<std::uint32_t>(room);
  sequence._length = 0;
  sequence._buffer = storage;
  sequence._release = false;  // the storage is ours
}

}  // namespace

FrameReport::FrameReport(const TelemetryNames& names)
    : dot_storage_(names.cameras.size() * limits::kDotsPerCamera), pixels_(limits::kImageChunkBytes) {
  lead_to(frame_set.cameras, cameras_.data(), names.cameras.size());
  for (std::size_t c = 0; c < names.cameras.size(); ++c) {
    set_text(cameras_[c].name, names.cameras[c].view());
    lead_to(dots[c].dots, dot_storage_.data() + c * limits::kDotsPerCamera, limits::kDotsPerCamera);
  }
  lead_to(image_chunk.pixels, pixels_.data(), pixels_.size());
  lead_to(health.groups, groups_.data(), groups_.size());
  lead_to(timing.steps, steps_.data(), steps_.size());
  lead_to(frame_timing.stages, stages_.data(), stages_.size());
  lead_to(parameters.values, parameters_.data(), parameters_.size());
  for (EventSample& event : events)
    lead_to(event.sample.values, event.record.values.data(), event.record.values.size());
}

}  // namespace omma::telemetry
