#include "ground/simulate/render_recording.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ground/simulate/simulation_folder.hpp"
#include "hal/recorded/image_file.hpp"
#include "sim/camera_renderer.hpp"
#include "sim/truth_json.hpp"

namespace omma::ground {
namespace {

// Renders frame sets, one at a time, on the calling thread.
class FrameSetRenderer {
 public:
  FrameSetRenderer(const sim::Scenario& scenario, std::span<const SkyStar> stars,
                   const std::vector<sim::CameraView>& views)
      : scenario_(scenario), views_(views), spots_(views.size()) {
    for (std::size_t c = 0; c < views.size(); ++c) {
      cameras_.push_back(
          std::make_unique<sim::CameraRenderer>(scenario, stars, views[c], static_cast<int>(c)));
    }
  }

  // Writes the images; returns the line of truth.
  std::string render(std::uint64_t frame, const SimulationFolder& folder) {
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      cameras_[c]->draw(frame);
      cameras_[c]->truth(spots_[c]);
      folder.write_image(static_cast<int>(c), frame, read_out(c));
    }
    return sim::truth_line(scenario_, frame, spots_);
  }

 private:
  ImageView read_out(std::size_t camera) {
    const sim::CameraView& view = views_[camera];
    const bool deep = view.sensor().bits > 8;
    image_.resize(view.width(), view.height(), deep ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
    image_.white_level = view.sensor().white_level();
    const std::size_t pixels =
        static_cast<std::size_t>(view.width()) * static_cast<std::size_t>(view.height());
    if (deep) {
      cameras_[camera]->read_out({reinterpret_cast<std::uint16_t*>(image_.pixels.data()), pixels});
    } else {
      cameras_[camera]->read_out({reinterpret_cast<std::uint8_t*>(image_.pixels.data()), pixels});
    }
    return image_.view();
  }

  const sim::Scenario& scenario_;
  const std::vector<sim::CameraView>& views_;
  std::vector<std::unique_ptr<sim::CameraRenderer>> cameras_;
  std::vector<std::vector<sim::SpotTruth>> spots_;
  Image image_;
};

std::vector<sim::CameraView> views_of(const sim::Scenario& scenario) {
  std::vector<sim::CameraView> views;
  for (std::size_t c = 0; c < scenario.rig.cameras.size(); ++c) {
    views.emplace_back(scenario.rig.cameras[c], scenario.sensors[c], scenario.seed, static_cast<int>(c));
  }
  return views;
}

// Each thread takes the next frame that nobody has; the first error stops them all and is thrown here.
std::vector<std::string> render_all(const sim::Scenario& scenario, const SimulationFolder& folder,
                                    int threads) {
  const std::vector<SkyStar> stars = sim::sky_of(scenario);
  const std::vector<sim::CameraView> views = views_of(scenario);
  std::vector<std::string> lines(static_cast<std::size_t>(scenario.frames));
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  auto work = [&] {
    try {
      FrameSetRenderer renderer(scenario, stars, views);
      for (std::size_t frame = next++; frame < lines.size(); frame = next++) {
        lines[frame] = renderer.render(frame, folder);
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
  folder.write_truth(render_all(scenario, folder, threads));
}

}  // namespace omma::ground
