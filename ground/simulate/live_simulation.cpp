#include "ground/simulate/live_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/interrupt.hpp"
#include "ground/simulate/frame_set_renderer.hpp"
#include "hal/shared_frames/shared_frames.hpp"

namespace omma::ground {
namespace {

/// The scenario with the settings that the readers ask for, and what renders it.
class ObedientScene {
 public:
  explicit ObedientScene(const sim::Scenario& scenario)
      : usual_(scenario), scenario_(scenario), stars_(sim::sky_of(scenario)) {
    prepare();
    images_.resize(views_.size());
    for (std::size_t c = 0; c < views_.size(); ++c) {
      const ImageView image = renderer_->image(c);
      writers_.push_back(std::make_unique<SharedFramesWriter>(
          std::string(scenario.rig.cameras[c].name.view()),
          GreyShape{image.width, image.height, image.format, image.white_level}));
    }
  }

  void render(std::uint64_t frame) {
    if (obey()) prepare();
    renderer_->draw(frame);
  }
  void publish(TimeNs midpoint_ns) {
    for (std::size_t c = 0; c < writers_.size(); ++c)
      writers_[c]->write(renderer_->image(c).data, midpoint_ns);
  }

 private:
  void prepare() {
    renderer_.reset();
    views_ = views_of(scenario_);
    renderer_.emplace(scenario_, stars_, views_);
    renderer_->draw(0);
  }
  // True where something changed.
  bool obey() {
    bool changed = false;
    for (std::size_t c = 0; c < writers_.size(); ++c) {
      sim::Sensor wanted = usual_.sensors[c];
      if (const int exposure_us = writers_[c]->exposure_us(); exposure_us > 0)
        wanted.exposure = exposure_us * 1e-6;
      if (const int gain = writers_[c]->gain_percent(); gain > 0)
        wanted.gain = usual_.sensors[c].gain * 100 / gain;
      sim::Sensor& now = scenario_.sensors[c];
      changed = changed || now.exposure != wanted.exposure || now.gain != wanted.gain;
      now = wanted;
    }
    return changed;
  }

  const sim::Scenario& usual_;
  sim::Scenario scenario_;
  std::vector<SkyStar> stars_;
  std::vector<sim::CameraView> views_;
  std::optional<FrameSetRenderer> renderer_;
  std::vector<std::unique_ptr<SharedFramesWriter>> writers_;
  std::vector<std::vector<std::byte>> images_;  // read out, waiting to be due
};

}  // namespace

void simulate_live(const sim::Scenario& scenario, const std::filesystem::path& log_file) {
  std::ofstream log;
  if (!log_file.empty()) {
    log.open(log_file);
    log << "frame,time_ns\n";
    if (!log) throw InputError(log_file.string(), 0, "--log", "a file that can be written", "none");
  }
  catch_interrupts();
  ObedientScene scene(scenario);
  MonotonicClock clock;
  const auto period = static_cast<TimeNs>(std::llround(1e9 / scenario.frame_rate));
  const TimeNs start = clock.now() + period;
  int late = 0;
  int frame = 0;
  for (; frame < scenario.frames && !interrupted(); ++frame) {
    scene.render(static_cast<std::uint64_t>(frame));
    const TimeNs due = start + frame * period;
    late += clock.now() > due ? 1 : 0;
    clock.sleep_until(due);
    // What was rendered late is told with the time at which it is given.
    const TimeNs given = std::max(due, clock.now());
    scene.publish(given);
    if (log.is_open()) log << frame << ',' << given << '\n' << std::flush;
  }
  std::printf("%d frame sets at %g Hz, %d of them late\n", frame, scenario.frame_rate, late);
}

}  // namespace omma::ground
