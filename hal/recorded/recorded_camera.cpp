#include "hal/recorded/recorded_camera.hpp"

#include <algorithm>
#include <charconv>
#include <exception>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

// The n of <camera>_<n>.png; false for any other name.
bool frame_number(std::string_view name, std::string_view camera, std::uint64_t& number) {
  constexpr std::string_view kEnding = ".png";
  if (!name.starts_with(camera) || !name.ends_with(kEnding)) return false;
  name.remove_prefix(camera.size());
  if (name.size() <= kEnding.size() + 1 || name[0] != '_') return false;
  const std::string_view digits = name.substr(1, name.size() - 1 - kEnding.size());
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} && end == digits.data() + digits.size();
}

std::string size_text(const ImageSize& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " px of " +
         std::to_string(size.bits) + " bits";
}

}  // namespace

std::vector<RecordedCamera::File> RecordedCamera::find_files(const std::filesystem::path& folder,
                                                             const std::string& camera) {
  std::error_code error;
  std::vector<File> files;
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    File file;
    if (frame_number(entry->path().filename().string(), camera, file.number)) {
      file.path = entry->path();
      files.push_back(std::move(file));
    }
  }
  if (error) throw InputError(folder.string(), 0, "recording", "a folder of frames", error.message());
  if (files.empty()) {
    throw InputError(folder.string(), 0, "recording", "frames named " + camera + "_<number>.png", "none");
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.number < b.number; });
  const auto twice = std::adjacent_find(files.begin(), files.end(),
                                        [](const File& a, const File& b) { return a.number == b.number; });
  if (twice != files.end()) {
    throw InputError(
        twice->path.string(), 0, "frame number", "a number no other frame has",
        std::to_string(twice->number) + " again in " + std::next(twice)->path.filename().string());
  }
  return files;
}

void RecordedCamera::check_headers(const RecordedCameraOptions& options) const {
  const ImageSize first = read_png_size(files_.front().path);
  ImageSize expected = first;
  if (options.width > 0) expected.width = options.width;
  if (options.height > 0) expected.height = options.height;
  if (options.bits > 0) expected.bits = options.bits;
  for (const File& file : files_) {
    const ImageSize size = read_png_size(file.path);
    if (size.width != expected.width || size.height != expected.height || size.bits != expected.bits) {
      throw InputError(file.path.string(), 0, "image size", size_text(expected), size_text(size));
    }
  }
}

// Later rounds are the same files under later numbers.
void RecordedCamera::repeat(const RecordedCameraOptions& options) {
  const std::size_t once = files_.size();
  const std::uint64_t length = std::max(options.round_length, files_.back().number + 1);
  files_.reserve(once * static_cast<std::size_t>(std::max(1, options.rounds)));
  for (int round = 1; round < options.rounds; ++round) {
    for (std::size_t i = 0; i < once; ++i)
      files_.push_back({files_[i].number + static_cast<std::uint64_t>(round) * length, files_[i].path});
  }
}

RecordedCamera::RecordedCamera(const std::filesystem::path& top, const std::string& camera,
                               const RecordedCameraOptions& options)
    : files_(find_files(top / camera, camera)),
      playback_(options.playback),
      white_level_(options.white_level) {
  check_headers(options);
  repeat(options);
  // The first frame is decoded here: a recording that cannot be read at all must fail now. Its size is
  // everyone's.
  const Image first = read_image(files_.front().path);
  for (Slot& slot : slots_) slot.image.resize(first.width, first.height, first.format);
  reader_ = std::thread([this] { read_ahead(); });
  if (playback_ == Playback::kRealTime) {
    const auto ready = static_cast<std::uint32_t>(std::min<std::size_t>(kSlots, files_.size()));
    for (std::uint32_t filled = 0; filled < ready; filled = filled_.load(std::memory_order_acquire)) {
      filled_.wait(filled, std::memory_order_acquire);
    }
  }
}

RecordedCamera::~RecordedCamera() {
  stop_.store(true, std::memory_order_release);
  released_.fetch_add(1, std::memory_order_release);  // changes what the reading thread may be waiting on
  released_.notify_one();
  reader_.join();
}

bool RecordedCamera::wait_for_free_slot(std::uint32_t filled) {
  for (;;) {
    const std::uint32_t released = released_.load(std::memory_order_acquire);
    if (stop_.load(std::memory_order_acquire)) return false;
    if (filled - released < kSlots) return true;
    released_.wait(released, std::memory_order_acquire);
  }
}

void RecordedCamera::fill(Slot& slot, const File& file, std::vector<std::byte>& bytes) {
  const Image& image = slot.image;
  const ImageSize size{image.width, image.height, image.bytes_per_pixel()};
  slot.number = file.number;
  try {
    read_bytes(file.path, bytes);
    read_png(bytes, file.path.string(), slot.image);
    slot.readable = true;
  } catch (const std::exception&) {  // a frame lost, not a mission
    slot.readable = false;
  }
  // The file may have been replaced since its header was looked at.
  if (image.width != size.width || image.height != size.height || image.bytes_per_pixel() != size.bits) {
    slot.image.resize(size.width, size.height, size.bits == 1 ? PixelFormat::kGrey8 : PixelFormat::kGrey16);
    slot.readable = false;
  }
  if (white_level_ > 0) slot.image.white_level = white_level_;
  if (!slot.readable) unreadable_.fetch_add(1, std::memory_order_relaxed);
}

void RecordedCamera::read_ahead() {
  std::vector<std::byte> bytes;
  std::uint32_t filled = 0;
  for (const File& file : files_) {
    // What is older than the newest number asked for would be thrown away unseen.
    if (file.number + 1 < asked_.load(std::memory_order_acquire)) continue;
    if (!wait_for_free_slot(filled)) return;
    if (file.number + 1 < asked_.load(std::memory_order_acquire)) continue;
    fill(slots_[filled % kSlots], file, bytes);
    filled_.store(++filled, std::memory_order_release);
    filled_.notify_one();
  }
}

Frame RecordedCamera::grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept {
  Frame frame;
  frame.number = number;
  frame.exposure_midpoint_ns = trigger_time_ns;
  if (number + 1 < asked_.load(std::memory_order_relaxed)) return frame;
  asked_.store(number + 1, std::memory_order_release);
  // The oldest slot is the frame of the last grab until here. Each turn frees a slot or waits for the next
  // frame; at most kSlots + 1 older frames can come before the reading thread skips them.
  std::uint32_t released = released_.load(std::memory_order_relaxed);
  for (;;) {
    const std::uint32_t filled = filled_.load(std::memory_order_acquire);
    if (released == filled) {
      if (playback_ == Playback::kRealTime || number > last_number()) return frame;
      filled_.wait(filled, std::memory_order_acquire);
      continue;
    }
    const Slot& slot = slots_[released % kSlots];
    if (slot.number >= number) {
      if (slot.number == number && slot.readable) {
        frame.image = slot.image.view();
        frame.status = FrameStatus::kFresh;
      }
      return frame;
    }
    released_.store(++released, std::memory_order_release);
    released_.notify_one();
  }
}

}  // namespace omma
