// POSIX: a rename is atomic, and durable once the folder is flushed.
#include "fsw/services/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace omma {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::filesystem::path& file, int error) {
  throw std::system_error(error, std::generic_category(), what + " " + file.string());
}

/// Closed when it goes.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags)
      : value_(open(file.c_str(), flags | O_CLOEXEC, 0644)) {
    if (value_ < 0) refuse("cannot open", file, errno);
  }
  ~Descriptor() { close(value_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

}  // namespace

void DurableFile::write(const std::filesystem::path& file, std::string_view bytes) {
  const Descriptor descriptor(file, O_WRONLY | O_CREAT | O_TRUNC);
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor.value(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) refuse("cannot write", file, errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void DurableFile::flush(const std::filesystem::path& file_or_folder) {
  const Descriptor descriptor(file_or_folder, O_RDONLY);
  if (fsync(descriptor.value()) != 0) refuse("cannot flush", file_or_folder, errno);
}

void DurableFile::rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) refuse("cannot rename", from, errno);
}

void DurableFile::replace(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path fresh = file.string() + ".new";
  write(fresh, bytes);
  flush(fresh);
  rename(fresh, file);
  flush(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace omma
