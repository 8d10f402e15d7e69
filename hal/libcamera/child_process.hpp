// A program started beside this one: what it prints comes through a pipe; it ends when its standard input
// does.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace omma {

class ChildProcess {
 public:
  ChildProcess() = default;
  ~ChildProcess() { end(); }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The program of that name beside this one, or where the system looks. Allocates.
  /// @return 0 or the errno
  int start(const std::string& program);
  /// False where it has ended.
  bool write_line(const std::string& line);
  /// The next line that it prints; none where none comes in time or it has ended. Allocates.
  std::optional<std::string> read_line(int timeout_ms);
  /// Asks it to end, and makes it end where it does not within half a second.
  void end() noexcept;

 private:
  pid_t process_ = -1;
  int input_ = -1;   // our end of its standard input
  int output_ = -1;  // of its standard output
  std::string read_;
};

}  // namespace omma
