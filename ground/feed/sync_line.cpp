#include "ground/feed/sync_line.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/interrupt.hpp"

namespace omma::ground {
namespace {

constexpr TimeNs kLook = 100'000;

}  // namespace

SyncLine::SyncLine(const std::string& file) : path_(file), file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0) throw InputError(path_, 0, "--fired-by", "a file that reads 0 or 1", std::strerror(errno));
  try {
    was_active_ = is_active();
  } catch (...) {
    ::close(file_);
    throw;
  }
}

SyncLine::~SyncLine() {
  ::close(file_);
}

bool SyncLine::is_active() const {
  char value = 0;
  const ssize_t count = ::pread(file_, &value, 1, 0);
  if (count != 1 || (value != '0' && value != '1'))
    throw InputError(path_, 0, "--fired-by", "0 or 1",
                     count < 0 ? std::string(std::strerror(errno)) : std::string("something else"));
  return value == '1';
}

TimeNs SyncLine::wait_for_edge() {
  MonotonicClock clock;
  for (TimeNs now = clock.now(); !interrupted(); now = clock.now()) {
    const bool active = is_active();
    const bool edge = active && !was_active_;
    was_active_ = active;
    if (edge) return now;
    clock.sleep_until(now + kLook);
  }
  return 0;
}

}  // namespace omma::ground
