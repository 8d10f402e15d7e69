// The steps by which a file's new content becomes durable, one by one, so that a test can end the power
// between any two of them: written under another name, flushed, renamed, and the folder flushed.
#pragma once

#include <filesystem>
#include <string_view>

namespace omma {

class DurableFile {
 public:
  virtual ~DurableFile() = default;

  // Each throws std::system_error where the system refuses.
  virtual void write(const std::filesystem::path& file, std::string_view bytes);
  virtual void flush(const std::filesystem::path& file_or_folder);
  virtual void rename(const std::filesystem::path& from, const std::filesystem::path& to);

  /// All of it: afterwards `file` holds `bytes`, whatever happens to the power; before, its old content.
  void replace(const std::filesystem::path& file, std::string_view bytes);
};

}  // namespace omma
