// Extractor: the frames of all cameras → their dots. One job a camera on the worker pool; the result does not
// depend on how many workers there are.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "components/camera/frames.hpp"
#include "components/extractor/camera_dots.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/extractor/extractor_tuning.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/kernel/worker_pool.hpp"
#include "fsw/services/parameter_input.hpp"

namespace omma {

class Extractor final : public Component {
 public:
  /// @param cameras  in the order of the rig
  /// @param pool     outlives this
  Extractor(std::span<const ExtractorCamera> cameras, WorkerPool& pool);

  In<Frames> frames;
  In<SearchWindows> windows;  ///< unbound: everywhere
  ParameterInput tuning;
  Out<DotLists> dots;

  std::string_view name() const override { return "extractor"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  void skipped(const Tick& tick) noexcept override;

 private:
  void take_news() noexcept;
  void extract_camera(std::size_t camera) noexcept;

  WorkerPool& pool_;
  std::vector<std::unique_ptr<CameraDots>> cameras_;
};

}  // namespace omma
