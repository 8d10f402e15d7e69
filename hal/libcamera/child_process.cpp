#include "hal/libcamera/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

namespace omma {
namespace {

using Clock = std::chrono::steady_clock;

/// Beside this program, or in the folders of PATH; empty where there is none. Looked for here and not left to
/// the spawning, which does not hear of it everywhere (an emulated processor's vfork is a fork).
std::string path_of(const std::string& program) {
  std::error_code error;
  const std::filesystem::path beside =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / program;
  if (::access(beside.c_str(), X_OK) == 0) return beside.string();
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path there = std::filesystem::path(folder) / program;
    if (::access(there.c_str(), X_OK) == 0) return there.string();
  }
  return {};
}

// What this program has set for its threads (priority, blocked signals) is not the child's.
int spawn(pid_t& process, const std::string& program, char* const* arguments, int input, int output) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  sched_param ordinary{};
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setschedpolicy(&attributes, SCHED_OTHER);
  posix_spawnattr_setschedparam(&attributes, &ordinary);
  // A group of its own: the terminal's interrupt is for this program, which ends the child.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                            POSIX_SPAWN_SETSCHEDULER | POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

void close_all(std::array<int, 4>& files) {
  for (const int file : files)
    if (file >= 0) ::close(file);
}

}  // namespace

int ChildProcess::start(const std::string& program) {
  end();
  const std::string path = path_of(program);
  if (path.empty()) return ENOENT;
  std::array<int, 4> files{-1, -1, -1, -1};  // its input: read, write; its output: read, write
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, files.data()) != 0 ||
      ::pipe2(files.data() + 2, O_CLOEXEC) != 0) {
    const int error = errno;
    close_all(files);
    return error;
  }
  const std::array<char*, 2> words{const_cast<char*>(path.c_str()), nullptr};
  const int error = spawn(process_, path, words.data(), files[0], files[3]);
  if (error != 0) {
    process_ = -1;
    close_all(files);
    return error;
  }
  ::close(files[0]);
  ::close(files[3]);
  input_ = files[1];
  output_ = files[2];
  return 0;
}

bool ChildProcess::write_line(const std::string& line) {
  const std::string text = line + "\n";
  // A socket, because writing to a pipe whose reader has ended is a signal.
  return process_ > 0 &&
         ::send(input_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

std::optional<std::string> ChildProcess::read_line(int timeout_ms) {
  const auto until = Clock::now() + std::chrono::milliseconds(timeout_ms);
  for (;;) {
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd wait{output_, POLLIN, 0};
    if (left <= 0 || ::poll(&wait, 1, static_cast<int>(left)) == 0) return std::nullopt;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(output_, bytes.data(), bytes.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return std::nullopt;
    if (count > 0) read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

void ChildProcess::end() noexcept {
  if (process_ < 0) return;
  ::close(input_);
  ::close(output_);
  const auto until = Clock::now() + std::chrono::milliseconds(500);
  pid_t ended = 0;
  while ((ended = ::waitpid(process_, nullptr, WNOHANG)) == 0 && Clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  if (ended == 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  process_ = -1;
  read_.clear();
}

}  // namespace omma
