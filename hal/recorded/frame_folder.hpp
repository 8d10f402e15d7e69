// The frames of one camera as files, <folder>/<camera>_<number>.png; .fits, .fit and .jpg are read as well.
// How they were exposed may lie beside them (exposures_file.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/recorded/exposures_file.hpp"
#include "hal/recorded/frame_store.hpp"

namespace omma {

struct FrameFile {
  std::uint64_t number = 0;
  std::filesystem::path path;
};

/// By rising number. @throws InputError: no folder, no frame in it, two files with one number
std::vector<FrameFile> find_frame_files(const std::filesystem::path& folder, const std::string& camera);

class FileFrames final : public FrameStore {
 public:
  /// @throws InputError as `find_frame_files` and `read_exposures`
  FileFrames(const std::filesystem::path& folder, const std::string& camera)
      : files_(find_frame_files(folder, camera)), exposures_(read_exposures(folder / kExposuresFile)) {}

  std::size_t count() const override { return files_.size(); }
  std::uint64_t number(std::size_t i) const override { return files_[i].number; }
  CameraSettings settings(std::size_t i) const override {
    const auto found = exposures_.find(files_[i].number);
    return found == exposures_.end() ? CameraSettings{} : found->second;
  }
  std::string name(std::size_t i) const override { return files_[i].path.string(); }
  ImageSize size(std::size_t i) override { return read_image_size(files_[i].path); }
  void read(std::size_t i, Image& image) override {
    read_bytes(files_[i].path, bytes_);
    read_image_bytes(bytes_, name(i), image);
  }

 private:
  std::vector<FrameFile> files_;
  std::map<std::uint64_t, CameraSettings> exposures_;
  std::vector<std::byte> bytes_;
};

}  // namespace omma
