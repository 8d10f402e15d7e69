#include "fsw/services/service_notice.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace omma {
namespace {

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// 0 where it is no number.
std::int64_t whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? value : 0;
}

}  // namespace

ServiceNotice::ServiceNotice(std::string socket_name, TimeNs watchdog_ns)
    : socket_(std::move(socket_name)), watchdog_ns_(watchdog_ns) {
  const bool fits = !socket_.empty() && socket_.size() < sizeof(sockaddr_un::sun_path);
  if (fits && (socket_[0] == '/' || socket_[0] == '@'))
    file_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

ServiceNotice::ServiceNotice(ServiceNotice&& other) noexcept
    : socket_(std::move(other.socket_)),
      watchdog_ns_(other.watchdog_ns_),
      file_(std::exchange(other.file_, -1)) {}

ServiceNotice::~ServiceNotice() {
  if (file_ >= 0) close(file_);
}

ServiceNotice ServiceNotice::from_environment() {
  const std::int64_t process = whole_number(variable("WATCHDOG_PID"));
  const bool for_us = process == 0 || process == getpid();
  const std::int64_t microseconds =
      for_us ? std::max<std::int64_t>(0, whole_number(variable("WATCHDOG_USEC"))) : 0;
  return ServiceNotice(std::string(variable("NOTIFY_SOCKET")), microseconds * 1000);
}

bool ServiceNotice::tell(std::string_view lines) noexcept {
  if (file_ < 0) return false;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(socket_.begin(), socket_.end(), address.sun_path);
  if (socket_[0] == '@') address.sun_path[0] = '\0';  // abstract: no file
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  const ssize_t sent = sendto(file_, lines.data(), lines.size(), MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&address), size);
  return sent == static_cast<ssize_t>(lines.size());
}

}  // namespace omma
