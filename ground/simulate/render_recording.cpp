#include "ground/simulate/render_recording.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ground/simulate/frame_set_renderer.hpp"
#include "ground/simulate/simulation_folder.hpp"

namespace omma::ground {
namespace {

// Each thread takes the next frame that nobody has; the first error stops them all and is thrown here.
std::vector<std::string> render_all(const sim::Scenario& scenario, const SimulationFolder& folder,
                                    int threads) {
  const std::vector<SkyStar> stars = sim::sky_of(scenario);
  // One of each exposure of a bracket.
  std::vector<sim::Scenario> exposed;
  std::vector<std::vector<sim::CameraView>> views;
  for (std::size_t k = 0; k < scenario.bracket_length(); ++k) exposed.push_back(scenario.exposed(k));
  for (const sim::Scenario& one : exposed) views.push_back(views_of(one));
  std::vector<std::string> lines(static_cast<std::size_t>(scenario.frames));
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  auto work = [&] {
    try {
      std::vector<std::unique_ptr<FrameSetRenderer>> renderers;
      for (std::size_t k = 0; k < exposed.size(); ++k)
        renderers.push_back(std::make_unique<FrameSetRenderer>(exposed[k], stars, views[k]));
      for (std::size_t frame = next++; frame < lines.size(); frame = next++) {
        FrameSetRenderer& renderer = *renderers[frame % renderers.size()];
        renderer.draw(frame);
        for (std::size_t c = 0; c < scenario.rig.cameras.size(); ++c)
          folder.write_image(static_cast<int>(c), frame, renderer.image(c));
        lines[frame] = renderer.truth();
      }
    } catch (...) {
      const std::scoped_lock lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = lines.size();
    }
  };
  std::vector<std::jthread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
  pool.clear();
  if (failure) std::rethrow_exception(failure);
  return lines;
}

}  // namespace

void render_recording(const sim::Scenario& scenario, const std::filesystem::path& top, int threads) {
  const SimulationFolder folder(top, scenario);
  folder.write_exposures();
  folder.write_truth(render_all(scenario, folder, threads));
}

}  // namespace omma::ground
