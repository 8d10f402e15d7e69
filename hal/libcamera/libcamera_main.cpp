// The program omma-libcamera, which libcamera_child.cpp starts: `list` prints the cameras, `capture NAME
// key=value...` writes a camera's frames into shared memory until its standard input ends. A process of its
// own: what libcamera does when a camera is unplugged ends this one alone.
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/kernel/real_time.hpp"
#include "hal/libcamera/libcamera_source.hpp"
#include "hal/libcamera/setup_words.hpp"
#include "hal/shared_frames/shared_frames.hpp"

namespace {

using namespace omma;

constexpr int kPollMs = 100;
constexpr int kPriority = 65;  // that of the threads which take live cameras' frames (fsw/app/camera_drivers)

void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

bool is_wanted() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return ::poll(&input, 1, 0) == 0;
}

int list() {
  for (const LibcameraDescription& camera : describe_libcameras()) {
    say("camera " + camera.id);
    say("model " + camera.model);
    for (const std::string& format : camera.formats) say("format " + format);
    for (const std::string& control : camera.controls) say("control " + control);
  }
  say("ready");
  return 0;
}

int capture(const std::string& name, std::span<const char* const> words) {
  // First of all, so that libcamera's threads have it too; without the right to it, it is an ordinary
  // program.
  make_thread_real_time("libcamera", kPriority);
  LibcameraSource source(setup_of_words(words));
  source.start();
  SharedFramesWriter frames(name, source.shape());
  std::vector<std::byte> pixels(source.shape().bytes());
  say("ready");
  while (is_wanted()) {
    const Taken taken = source.take(pixels.data(), kPollMs);
    if (taken.status == TakeStatus::kGone) std::_Exit(3);  // libcamera cannot stop what is gone
    if (taken.status == TakeStatus::kSilence) continue;
    frames.write(taken.status == TakeStatus::kFrame ? pixels.data() : nullptr, taken.time_ns, taken.sequence);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<const char* const> words(argv, static_cast<std::size_t>(argc));
  try {
    if (words.size() == 2 && std::string_view(words[1]) == "list") return list();
    if (words.size() > 2 && std::string_view(words[1]) == "capture")
      return capture(words[2], words.subspan(3));
    std::fputs("usage: omma-libcamera list | capture NAME key=value...\n", stderr);
  } catch (const std::exception& error) {
    say(std::string("refused ") + error.what());
  }
  return 2;
}
