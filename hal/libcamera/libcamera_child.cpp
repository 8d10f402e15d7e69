#include "hal/libcamera/libcamera_child.hpp"

#include <unistd.h>

#include <atomic>
#include <bit>
#include <cstring>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string_view>

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/child_process.hpp"
#include "hal/libcamera/setup_words.hpp"
#include "hal/shared_frames/shared_source.hpp"

namespace omma {
namespace {

constexpr const char* kProgram = "omma-libcamera";
constexpr int kStartMs = 10'000;  // that a camera may take to stream; sensors that load firmware take seconds

/// The process of all cameras that libcamera drives for this program.
class Service {
 public:
  /// The one that runs, or a new one. @throws InputError where it cannot be started
  static std::shared_ptr<Service> get(const std::string& where) {
    static std::mutex mutex;
    static std::weak_ptr<Service> running;
    const std::lock_guard<std::mutex> lock(mutex);
    if (auto already = running.lock(); already && !already->ended_.load()) return already;
    auto made = std::make_shared<Service>();
    if (const int error = made->process_.start(kProgram); error != 0) {
      throw InputError(where, 0, "driver",
                       std::string("the program ") + kProgram +
                           " of the driver libcamera, which is built where libcamera-dev is installed",
                       std::strerror(error));
    }
    running = made;
    return made;
  }

  /// One line of it for each line of the answer. @throws std::runtime_error: what it refuses, in its own
  /// words; InputError where it ends
  void ask(const std::string& where, const std::string& line,
           const std::function<void(const std::string&)>& take) {
    constexpr std::string_view kRefused = "refused ";
    const std::lock_guard<std::mutex> lock(mutex_);
    bool heard = process_.write_line(line);
    while (heard) {
      const auto answer = process_.read_line(kStartMs);
      if (answer == "ready") return;
      if (answer && answer->rfind(kRefused, 0) == 0)
        throw std::runtime_error(answer->substr(kRefused.size()));
      heard = answer.has_value();
      if (heard) take(*answer);
    }
    ended_.store(true);
    process_.end();
    throw InputError(where, 0, "device", std::string("an answer of ") + kProgram,
                     "none: it ended, or took longer than 10 s");
  }
  void ask(const std::string& where, const std::string& line) {
    ask(where, line, [](const std::string&) {});
  }

 private:
  ChildProcess process_;
  std::mutex mutex_;
  std::atomic<bool> ended_{false};
};

// The frames as they lie in the shared memory: grey already.
CameraSetup grey_setup(const CameraSetup& setup, const std::string& name) {
  const GreyShape shape = shape_of(setup);
  CameraSetup grey;
  grey.where = setup.where;
  grey.device = name;
  grey.width = shape.width;
  grey.height = shape.height;
  grey.bits = std::bit_width(unsigned{shape.white_level});
  grey.format = grey.bits > 8 ? "Y16" : "GREY";
  return grey;
}

std::string unique_name() {
  static std::atomic<unsigned> count{0};
  return "libcamera-" + std::to_string(::getpid()) + "-" + std::to_string(count.fetch_add(1));
}

class LibcameraChild final : public FrameSource {
 public:
  explicit LibcameraChild(const CameraSetup& setup)
      : setup_(setup), name_(unique_name()), frames_(grey_setup(setup_, name_)) {}
  ~LibcameraChild() override { stop(); }
  LibcameraChild(const LibcameraChild&) = delete;
  LibcameraChild& operator=(const LibcameraChild&) = delete;

  std::string_view driver_name() const override { return "libcamera"; }
  GreyShape shape() const override { return frames_.shape(); }
  void start() override {
    stop();
    std::string line = "open " + name_;
    for (const std::string& word : words_of(setup_)) line += "\t" + word;
    service_ = Service::get(setup_.where);
    try {
      service_->ask(setup_.where, line);
      frames_.start();
    } catch (...) {
      stop();
      throw;
    }
  }
  void stop() noexcept override {
    frames_.stop();
    try {
      if (service_) service_->ask(setup_.where, "close " + name_);
    } catch (const std::exception&) {  // it has ended, which closes the camera as well
    }
    service_.reset();
    ::unlink(path_.c_str());  // where it died it has left them
  }
  Taken take(std::byte* pixels, int timeout_ms) noexcept override { return frames_.take(pixels, timeout_ms); }

 private:
  CameraSetup setup_;
  std::string name_;
  std::string path_ = SharedFramesMemory::path_of(name_);
  SharedSource frames_;
  std::shared_ptr<Service> service_;  // none while it is stopped
};

}  // namespace

std::unique_ptr<FrameSource> make_libcamera_source(const CameraSetup& setup) {
  return std::make_unique<LibcameraChild>(setup);
}

std::vector<LibcameraDescription> list_libcameras() {
  std::vector<LibcameraDescription> cameras;
  Service::get("libcamera")->ask("libcamera", "list", [&](const std::string& line) {
    const std::size_t space = line.find(' ');
    const std::string word = line.substr(0, space);
    const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
    if (word == "camera") cameras.push_back({value, {}, {}, {}});
    if (cameras.empty()) return;
    if (word == "model") cameras.back().model = value;
    if (word == "format") cameras.back().formats.push_back(value);
    if (word == "control") cameras.back().controls.push_back(value);
  });
  return cameras;
}

}  // namespace omma
