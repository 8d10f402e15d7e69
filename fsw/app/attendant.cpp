#include "fsw/app/attendant.hpp"

namespace omma {

void Attendant::start() {
  if (!duties_.empty()) thread_ = std::thread([this] { run(); });
}

void Attendant::stop() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Attendant::run() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kPause, [this] { return ends_; })) {
    lock.unlock();
    for (const auto& duty : duties_) duty();
    lock.lock();
  }
}

}  // namespace omma
