#include "hal/libcamera/libcamera_child.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/child_process.hpp"
#include "hal/libcamera/setup_words.hpp"
#include "hal/shared_frames/shared_source.hpp"

namespace omma {
namespace {

constexpr const char* kProgram = "omma-libcamera";
constexpr int kStartMs = 10'000;  // that a camera may take to stream; sensors that load firmware take seconds

/// A process of omma-libcamera.
class Service {
 public:
  /// @throws InputError where it cannot be started
  explicit Service(const std::string& where) {
    if (const int error = process_.start(kProgram); error != 0) {
      throw InputError(where, 0, "driver",
                       std::string("the program ") + kProgram +
                           " of the driver libcamera, which is built where libcamera-dev is installed",
                       std::strerror(error));
    }
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
    process_.end();
    throw InputError(where, 0, "device", std::string("an answer of ") + kProgram,
                     "none: it ended, or took longer than 10 s");
  }
  void ask(const std::string& where, const std::string& line) {
    ask(where, line, [](const std::string&) {});
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    process_.end();
  }
  /// The cameras it found when it started, by their ids and models.
  std::set<std::string> cameras(const std::string& where) {
    std::set<std::string> names;
    ask(where, "list", [&](const std::string& line) {
      for (const std::string_view key : {"camera ", "model "})
        if (line.rfind(key, 0) == 0) names.insert(line.substr(key.size()));
    });
    return names;
  }

 private:
  ChildProcess process_;
  std::mutex mutex_;
};

/// Which process drives which camera: each camera has one of its own, so that one which is unplugged takes no
/// other with it. Some of libcamera's pipelines (vimc's, IPU3's) cannot look for cameras while one of theirs
/// streams: a new process finds none of them. Such cameras share the process that found them all.
class Processes {
 public:
  static Processes& all() {
    static Processes one;
    return one;
  }

  /// Opens the camera by that line. @throws InputError and std::runtime_error as Service
  std::shared_ptr<Service> open(const std::string& where, const std::string& device,
                                const std::string& line) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::erase_if(running_, [](const Running& one) { return one.service.expired(); });
    // Looking for cameras is work: a camera that was not there is looked for again where something has
    // changed.
    if (const auto missing = missing_.find(device); missing != missing_.end()) {
      if (missing->second.where_looked == surroundings()) throw std::runtime_error(missing->second.refusal);
      missing_.erase(missing);
    }
    auto own = std::make_shared<Service>(where);
    try {
      own->ask(where, line);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      const std::set<std::string> found = own->cameras(where);
      own.reset();
      if (found.count(device) != 0) throw;
      own = open_in_another(where, line, found);
      if (!own && media_devices().settled) missing_[device] = {surroundings(), error.what()};
      if (!own) throw;
    }
    running_.push_back({device, own});
    return own;
  }

 private:
  struct Running {
    std::string device;
    std::weak_ptr<Service> service;
  };

  struct Missing {
    std::string where_looked;
    std::string refusal;
  };

  /// What a search depends on.
  std::string surroundings() const {
    std::string all;
    for (const std::string& device : media_devices().present) all += device + "\n";
    for (const Running& one : running_)
      if (!one.service.expired()) all += one.device + "\n";
    return all;
  }

  std::shared_ptr<Service> open_in_another(const std::string& where, const std::string& line,
                                           const std::set<std::string>& found) {
    for (const Running& one : running_) {
      auto service = one.service.lock();
      try {
        if (service) service->ask(where, line);
        if (service) return service;
      } catch (const std::exception&) {  // it does not know the camera either
      }
    }
    // A camera that streams and is not found: the search was in vain for its stream's sake. They are let go
    // once, each time a device has come, and come back by themselves.
    const bool hampered = std::any_of(running_.begin(), running_.end(),
                                      [&](const Running& one) { return found.count(one.device) == 0; });
    const MediaDevices devices = media_devices();
    const bool come =
        !std::includes(known_.begin(), known_.end(), devices.present.begin(), devices.present.end());
    if (!hampered || !devices.settled || !come) return nullptr;
    known_ = devices.present;
    for (const Running& one : running_)
      if (const auto service = one.service.lock()) service->end();
    auto own = std::make_shared<Service>(where);
    try {
      own->ask(where, line);
      return own;
    } catch (const std::exception&) {  // not there
      return nullptr;
    }
  }

  struct MediaDevices {
    std::set<std::string> present;  // another word for one that comes back, though under the same name
    bool settled = false;  // the newest has been there for a second: so have the nodes that belong to it
  };

  static MediaDevices media_devices() {
    MediaDevices devices;
    std::time_t newest = 0;
    std::error_code error;
    for (auto entry = std::filesystem::directory_iterator("/dev", error);
         !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
      struct stat about {};
      if (entry->path().filename().string().rfind("media", 0) != 0 ||
          ::stat(entry->path().c_str(), &about) != 0)
        continue;
      newest = std::max(newest, about.st_ctim.tv_sec);
      devices.present.insert(entry->path().string() + " " + std::to_string(about.st_ctim.tv_sec) + "." +
                             std::to_string(about.st_ctim.tv_nsec));
    }
    devices.settled = std::time(nullptr) > newest + 1;
    return devices;
  }

  std::mutex mutex_;
  std::vector<Running> running_;
  std::map<std::string, Missing> missing_;
  std::set<std::string> known_ = media_devices().present;  // from the start, and what cameras were let go for
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
    service_ = Processes::all().open(setup_.where, setup_.device, line);
    try {
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
  Service service("libcamera");
  service.ask("libcamera", "list", [&](const std::string& line) {
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
