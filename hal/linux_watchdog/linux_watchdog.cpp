#include "hal/linux_watchdog/linux_watchdog.hpp"

#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

bool write_byte(int file, char byte) noexcept {
  return write(file, &byte, 1) == 1;
}

std::string reason() {
  return std::strerror(errno);
}

}  // namespace

LinuxWatchdog::LinuxWatchdog(const std::filesystem::path& device, int timeout_s)
    : file_(open(device.c_str(), O_WRONLY | O_CLOEXEC)) {
  const auto refuse = [&](const char* field, const std::string& expected, const std::string& found) {
    if (file_ >= 0) {
      write_byte(file_, 'V');
      close(file_);
    }
    throw InputError(device.string(), 0, field, expected, found);
  };
  if (file_ < 0) refuse("watchdog", "a device that can be opened", reason());
  watchdog_info info{};
  if (ioctl(file_, WDIOC_GETSUPPORT, &info) != 0) refuse("watchdog", "a watchdog device", reason());
  const auto* const identity = reinterpret_cast<const char*>(info.identity);
  identity_.assign(identity, strnlen(identity, sizeof info.identity));
  can_disarm_ = (info.options & WDIOF_MAGICCLOSE) != 0;
  int seconds = timeout_s;
  if (ioctl(file_, WDIOC_SETTIMEOUT, &seconds) != 0)
    refuse("watchdog timeout", "a time-out that " + identity_ + " can keep",
           std::to_string(timeout_s) + " s: " + reason());
  if (ioctl(file_, WDIOC_GETTIMEOUT, &seconds) != 0 || seconds <= 0)
    refuse("watchdog timeout", "one that " + identity_ + " tells", reason());
  timeout_ns_ = seconds * kSecond;
  int status = 0;
  caused_last_reset_ = ioctl(file_, WDIOC_GETBOOTSTATUS, &status) == 0 && (status & WDIOF_CARDRESET) != 0;
}

LinuxWatchdog::~LinuxWatchdog() {
  if (file_ >= 0) close(file_);
}

bool LinuxWatchdog::stroke() noexcept {
  return file_ >= 0 && ioctl(file_, WDIOC_KEEPALIVE, 0) == 0;
}

bool LinuxWatchdog::disarm() noexcept {
  if (file_ < 0) return true;
  const bool told = write_byte(file_, 'V');
  close(file_);
  file_ = -1;
  return told && can_disarm_;
}

}  // namespace omma
