#include "hal/recorded/frame_folder.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr std::array<std::string_view, 4> kEndings{".png", ".fits", ".fit", ".jpg"};

// The n of <camera>_<n>.png; false for any other name.
bool frame_number(std::string_view name, std::string_view camera, std::uint64_t& number) {
  const auto* const ending = std::find_if(kEndings.begin(), kEndings.end(),
                                          [&](std::string_view one) { return name.ends_with(one); });
  if (!name.starts_with(camera) || ending == kEndings.end()) return false;
  name.remove_prefix(camera.size());
  if (name.size() <= ending->size() + 1 || name[0] != '_') return false;
  const std::string_view digits = name.substr(1, name.size() - 1 - ending->size());
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} && end == digits.data() + digits.size();
}

}  // namespace

std::vector<FrameFile> find_frame_files(const std::filesystem::path& folder, const std::string& camera) {
  std::error_code error;
  std::vector<FrameFile> files;
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    FrameFile file;
    if (frame_number(entry->path().filename().string(), camera, file.number)) {
      file.path = entry->path();
      files.push_back(std::move(file));
    }
  }
  if (error) throw InputError(folder.string(), 0, "recording", "a folder of frames", error.message());
  if (files.empty()) {
    throw InputError(folder.string(), 0, "recording", "frames named " + camera + "_<number>.png", "none");
  }
  std::sort(files.begin(), files.end(),
            [](const FrameFile& a, const FrameFile& b) { return a.number < b.number; });
  const auto twice =
      std::adjacent_find(files.begin(), files.end(),
                         [](const FrameFile& a, const FrameFile& b) { return a.number == b.number; });
  if (twice != files.end()) {
    throw InputError(
        twice->path.string(), 0, "frame number", "a number no other frame has",
        std::to_string(twice->number) + " again in " + std::next(twice)->path.filename().string());
  }
  return files;
}

}  // namespace omma
