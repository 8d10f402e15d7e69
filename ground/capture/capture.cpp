#include "ground/capture/capture.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "ground/capture/capture_options.hpp"
#include "ground/capture/half_blocks.hpp"
#include "ground/capture/recorder.hpp"
#include "ground/capture/view_server.hpp"
#include "ground/interrupt.hpp"

namespace omma::ground {
namespace {

using Clock = std::chrono::steady_clock;

struct CaptureOptions {
  CaptureArguments cameras;
  RecorderOptions recorder;
  double seconds = 0;
  bool view = false;
  std::string serve;  // [ADDRESS:]PORT; empty: no page
};

void show(Recorders& recorders) {
  constexpr int kColumns = 100, kRows = 30;
  std::printf("\033[H\033[2J");
  for (Recorder& recorder : recorders) {
    const auto shown = recorder.shown().newest();
    std::printf("%s  %llu frames, %.1f Hz\n%s", recorder.name().c_str(),
                static_cast<unsigned long long>(recorder.taken()), recorder.newest_rate_hz(),
                shown ? half_blocks(shown->image.view(), kColumns, kRows).c_str() : "");
    recorder.shown().ask();
  }
  std::fflush(stdout);
}

// Says when a camera is lost and when it is back.
void tell_changes(const Recorders& recorders, std::vector<CameraHealth>& told) {
  std::size_t i = 0;
  for (const Recorder& recorder : recorders) {
    const CameraHealth now = recorder.health();
    CameraHealth& before = told[i++];
    if (now.losses != before.losses)
      std::fprintf(stderr, "%s: gone or silent, looked for\n", recorder.name().c_str());
    if (now.connected && !before.connected)
      std::fprintf(stderr, "%s: delivers again\n", recorder.name().c_str());
    before = now;
  }
}

void wait_for_end(Recorders& recorders, const CaptureOptions& options) {
  const Clock::time_point begin = Clock::now();
  std::vector<CameraHealth> told(recorders.size());
  for (;;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    tell_changes(recorders, told);
    if (options.view) show(recorders);
    const bool all_done =
        std::all_of(recorders.begin(), recorders.end(), [](const Recorder& r) { return r.done(); });
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (all_done || interrupted() || (options.seconds > 0 && seconds >= options.seconds)) return;
  }
}

/// @return true where every frame the devices counted is there
bool print_result(const Recorders& recorders) {
  bool complete = true;
  double total_bytes = 0;
  double longest = 0;
  for (const Recorder& recorder : recorders) {
    const CameraHealth health = recorder.health();
    std::printf(
        "%s: %llu frames of %d x %d px at %.2f Hz; lost: %u gaps, %u damaged, %u without room; "
        "%u times gone\n",
        recorder.name().c_str(), static_cast<unsigned long long>(recorder.taken()), recorder.shape().width,
        recorder.shape().height, recorder.rate_hz(), health.gaps, health.damaged, health.overrun,
        health.losses);
    if (!recorder.failure().empty()) std::fprintf(stderr, "omma: %s\n", recorder.failure().c_str());
    complete = complete && recorder.complete();
    total_bytes += static_cast<double>(recorder.bytes());
    longest = std::max(longest, recorder.seconds());
  }
  if (total_bytes > 0 && longest > 0)
    std::printf("%.1f MB written, %.1f MB/s sustained\n", total_bytes / 1e6, total_bytes / 1e6 / longest);
  return complete;
}

int capture(const CaptureOptions& options) {
  const std::vector<CaptureCamera> cameras = capture_cameras(options.cameras);
  std::optional<ViewAddress> address;
  if (!options.serve.empty()) address = read_view_address(options.serve);
  catch_interrupts();
  CaptureStart start;
  Recorders recorders;
  for (const CaptureCamera& camera : cameras) recorders.emplace_back(camera, options.recorder, start);
  std::optional<ViewServer> server;
  if (address) {
    server.emplace(recorders, *address);
    std::fprintf(stderr, "live view: %s\n", url_of(server->address()).c_str());
  }
  for (Recorder& recorder : recorders) recorder.start();
  wait_for_end(recorders, options);
  for (Recorder& recorder : recorders) recorder.stop();
  if (!options.recorder.output.empty()) {
    const Clock::time_point begin = Clock::now();
    ::sync();
    std::printf("all on the disk %.2f s after the last frame\n",
                std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return print_result(recorders) ? 0 : 1;
}

}  // namespace

void add_capture(CLI::App& app, CommandContext& context) {
  auto o = std::make_shared<CaptureOptions>();
  CaptureArguments& a = o->cameras;
  CLI::App* command = app.add_subcommand("capture", "Write frames of live cameras to disk, or look at them");
  command->add_option("mission", a.mission, "Mission file whose live cameras are captured");
  command->add_option("--camera", a.cameras, "NAME=DRIVER:DEVICE, instead of a mission; may be repeated");
  command->add_option("--size", a.size, "Of the images, WIDTHxHEIGHT");
  command->add_option("--format", a.format, "Of the pixels, as `omma cameras` lists it");
  command->add_option("--bayer", a.bayer, "A colour mosaic becomes: grey, green or raw")
      ->check(CLI::IsMember({"grey", "green", "raw"}));
  command->add_option("--memory", a.memory, "mmap or dma-buf")->check(CLI::IsMember({"mmap", "dma-buf"}));
  command->add_option("--memory-from", a.memory_from,
                      "Whose DMA-bufs the device fills: a DMA heap (/dev/dma_heap/system) or another video "
                      "device; its own where left out");
  command->add_option("--rate", a.rate_hz, "Asked of the device [Hz]")->check(CLI::Range(0.0, 1000.0));
  command->add_option("--timeout-ms", a.timeout_ms, "Silence after which the stream is started anew")
      ->check(CLI::Range(10, 60000));
  command->add_option("--set", a.controls,
                      "NAME=VALUE: a control, for instance exposure=100; may be repeated");
  command->add_option("--output", o->recorder.output, "Folder; without it frames are only counted");
  command->add_option("--frames", o->recorder.frames, "Stop after so many of each camera");
  command->add_option("--seconds", o->seconds, "Stop after so long");
  command->add_flag("--compress", o->recorder.compress, "Smaller files, more work");
  command->add_flag("--view", o->view, "Show the cameras in the terminal");
  command->add_option("--serve", o->serve,
                      "Show the cameras in a browser: PORT for this machine's, 0.0.0.0:PORT for others'");
  command->callback([o, &context] { context.exit_code = capture(*o); });
}

}  // namespace omma::ground
