// The program omma-libcamera, which libcamera_child.cpp starts: a process of its own, because libcamera does
// not outlive a camera that is unplugged. Until its standard input ends it takes there, a line each, with its
// answer a line as well,
//   list                         "camera ID", "model ...", "format ...", "control ..." lines, then "ready"
//   open NAME\tkey=value\t...    frames of a camera into shared memory of that name: "ready", or "refused"
//   and why close NAME                   "ready"
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "fsw/kernel/real_time.hpp"
#include "hal/libcamera/libcamera_source.hpp"
#include "hal/libcamera/setup_words.hpp"
#include "hal/shared_frames/shared_frames.hpp"

namespace {

using namespace omma;

constexpr int kPollMs = 100;
constexpr int kPriority = 65;  // that of the threads which take live cameras' frames (fsw/app/camera_drivers)
constexpr int kLibcameraPriority = 64;  // its thread spins where a device is gone: below who notices that

void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/// A camera that streams into shared memory until it is closed or gone; the memory's writer ends with it.
class Capture {
 public:
  Capture(const std::string& name, const CameraSetup& setup) : source_(setup) {
    source_.start();
    frames_ = std::make_unique<SharedFramesWriter>(name, source_.shape());
    pixels_.resize(source_.shape().bytes());
    thread_ = std::thread([this] { run(); });
  }
  ~Capture() {
    ends_.store(true);
    thread_.join();
    source_.stop();
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

 private:
  void run() {
    make_thread_real_time("libcamera frames", kPriority);
    while (!ends_.load()) {
      const Taken taken = source_.take(pixels_.data(), kPollMs);
      // libcamera 0.0.3 does not stop a camera that is gone: its program ends, and with it what spins in
      // there.
      if (taken.status == TakeStatus::kGone) std::_Exit(1);
      if (taken.status == TakeStatus::kSilence) continue;
      frames_->write(taken.status == TakeStatus::kFrame ? pixels_.data() : nullptr, taken.time_ns,
                     taken.sequence);
    }
  }

  LibcameraSource source_;
  std::unique_ptr<SharedFramesWriter> frames_;
  std::vector<std::byte> pixels_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

void list() {
  for (const LibcameraDescription& camera : describe_libcameras()) {
    say("camera " + camera.id);
    say("model " + camera.model);
    for (const std::string& format : camera.formats) say("format " + format);
    for (const std::string& control : camera.controls) say("control " + control);
  }
}

class Captures {
 public:
  void answer(const std::string& line) {
    const std::vector<std::string> words = split(line, '\t');
    const std::vector<std::string> verb = split(words.front(), ' ');
    if (verb.front() == "list") {
      list();
    } else if (verb.front() == "open" && verb.size() == 2) {
      open_.erase(verb[1]);
      open_.emplace(verb[1],
                    std::make_unique<Capture>(verb[1], setup_of_words({words.begin() + 1, words.end()})));
    } else if (verb.front() == "close" && verb.size() == 2) {
      open_.erase(verb[1]);
    } else {
      throw std::runtime_error("omma-libcamera: list, open or close expected, found " + words.front());
    }
  }

 private:
  static std::vector<std::string> split(const std::string& line, char by) {
    std::vector<std::string> words;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
      end = line.find(by, begin);
      words.push_back(line.substr(begin, end == std::string::npos ? end : end - begin));
    }
    return words;
  }

  std::map<std::string, std::unique_ptr<Capture>> open_;
};

}  // namespace

// libcamera listens for devices that come and go by this function of libudev's; without it, it looks once,
// through sysfs. libcamera 0.0.3 ends its program when it hears of one, whosever camera that is.
extern "C" void* udev_monitor_new_from_netlink(void* /*udev*/, const char* /*name*/) {
  return nullptr;
}

int main() {
  // First of all, so that libcamera's threads have it too; without the right to it, it is an ordinary
  // program.
  make_thread_real_time("libcamera", kLibcameraPriority);
  Captures captures;
  for (std::string line; std::getline(std::cin, line);) {
    try {
      captures.answer(line);
      say("ready");
    } catch (const std::exception& error) {
      say(std::string("refused ") + error.what());
    }
  }
}
