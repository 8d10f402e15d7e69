#include "components/extractor/extractor.hpp"

namespace omma {

Extractor::Extractor(std::span<const ExtractorCamera> cameras, WorkerPool& pool) : pool_(pool) {
  for (const ExtractorCamera& camera : cameras) {
    cameras_.push_back(std::make_unique<CameraDots>(camera));
  }
  dots->cameras.resize(cameras.size());
}

void Extractor::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  if (windows.source() != nullptr) visitor.input("windows", windows);
  if (tuning.bound()) visitor.input("tuning", tuning.port());
  visitor.output("dots", dots);
}

void Extractor::step(const Tick& /*tick*/) noexcept {
  if (tuning.has_news()) take_news();
  dots->frame = frames->number;
  dots->time_ns = frames->trigger_time_ns;
  pool_.run(static_cast<int>(cameras_.size()),
            [this](int camera) { extract_camera(static_cast<std::size_t>(camera)); });
  // The frame set's time is that of its fresh frames; all cameras expose on one trigger.
  for (const DotList& list : dots->cameras) {
    if (list.status == FrameStatus::kFresh) dots->time_ns = list.time_ns;
  }
}

void Extractor::take_news() noexcept {
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    ExtractorParameters parameters = cameras_[c]->parameters();
    take_parameters(*tuning, parameters, c);
    cameras_[c]->tune(parameters);
  }
}

void Extractor::skipped(const Tick& /*tick*/) noexcept {
  dots->frame = frames->number;
  dots->time_ns = frames->trigger_time_ns;
  for (DotList& list : dots->cameras) {
    list.frame = frames->number;
    list.time_ns = frames->trigger_time_ns;
    list.status = FrameStatus::kMissing;
    list.dots.clear();
    list.dropped = 0;
  }
}

void Extractor::extract_camera(std::size_t camera) noexcept {
  const Frame& frame = frames->cameras[camera];
  DotList& list = dots->cameras[camera];
  list.frame = frames->number;
  list.time_ns = frame.exposure_midpoint_ns;
  list.status = frame.status;
  list.dots.clear();
  list.dropped = 0;
  // Only a frame of this trigger may be used: an old one shows where the sky was.
  if (frame.status != FrameStatus::kFresh) return;
  const bool told = windows.source() != nullptr && camera < windows->cameras.size();
  cameras_[camera]->find(frame.image, list, told ? &windows->cameras[camera] : nullptr);
}

}  // namespace omma
