#include "hal/libcamera/libcamera_child.hpp"

#include <unistd.h>

#include <atomic>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/child_process.hpp"
#include "hal/libcamera/setup_words.hpp"
#include "hal/shared_frames/shared_source.hpp"

namespace omma {
namespace {

constexpr const char* kProgram = "omma-libcamera";
constexpr int kStartMs = 10'000;  // that a camera may take to stream; sensors that load firmware take seconds

void start_program(ChildProcess& process, const std::string& where, const std::vector<std::string>& words) {
  if (const int error = process.start(kProgram, words); error != 0) {
    throw InputError(where, 0, "driver",
                     std::string("the program ") + kProgram +
                         " of the driver libcamera, which is built where libcamera-dev is installed",
                     std::strerror(error));
  }
}

// What is refused over there is the same sentence here.
[[noreturn]] void pass_on(const std::string& where, const std::optional<std::string>& line) {
  constexpr std::string_view kRefused = "refused ";
  if (line && line->rfind(kRefused, 0) == 0) throw std::runtime_error(line->substr(kRefused.size()));
  throw InputError(where, 0, "device", std::string("a stream from ") + kProgram,
                   line ? *line : "none: it ended, or took longer than 10 s");
}

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
    std::vector<std::string> words{"capture", name_};
    for (std::string& word : words_of(setup_)) words.push_back(std::move(word));
    start_program(process_, setup_.where, words);
    try {
      if (const auto line = process_.read_line(kStartMs); line != "ready") pass_on(setup_.where, line);
      frames_.start();
    } catch (...) {
      stop();
      throw;
    }
  }
  void stop() noexcept override {
    frames_.stop();
    process_.end();
    ::unlink(path_.c_str());  // where it died it has left them
  }
  Taken take(std::byte* pixels, int timeout_ms) noexcept override { return frames_.take(pixels, timeout_ms); }

 private:
  CameraSetup setup_;
  std::string name_;
  std::string path_ = SharedFramesMemory::path_of(name_);
  SharedSource frames_;
  ChildProcess process_;
};

}  // namespace

std::unique_ptr<FrameSource> make_libcamera_source(const CameraSetup& setup) {
  return std::make_unique<LibcameraChild>(setup);
}

std::vector<LibcameraDescription> list_libcameras() {
  ChildProcess process;
  start_program(process, "libcamera", {"list"});
  std::vector<LibcameraDescription> cameras;
  for (;;) {
    const auto line = process.read_line(kStartMs);
    if (line == "ready") return cameras;
    const std::size_t space = line ? line->find(' ') : std::string::npos;
    if (space == std::string::npos) pass_on("libcamera", line);
    const std::string word = line->substr(0, space);
    const std::string value = line->substr(space + 1);
    if (word == "camera")
      cameras.push_back({value, {}, {}, {}});
    else if (cameras.empty())
      pass_on("libcamera", line);
    else if (word == "model")
      cameras.back().model = value;
    else if (word == "format")
      cameras.back().formats.push_back(value);
    else if (word == "control")
      cameras.back().controls.push_back(value);
    else
      pass_on("libcamera", line);
  }
}

}  // namespace omma
