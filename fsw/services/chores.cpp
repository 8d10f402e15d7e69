// The life of the chores' thread.
#include "fsw/services/chores.hpp"

namespace omma {

void Chores::start() {
  thread_ = std::thread([this] { serve(); });
}

void Chores::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Chores::serve() {
  std::unique_lock lock(mutex_);
  for (bool last_round = false; !last_round;) {
    wake_.wait_for(lock, period_, [this] { return ending_; });
    last_round = ending_;
    lock.unlock();
    for (const auto& chore : chores_) chore();
    lock.lock();
  }
}

}  // namespace omma
