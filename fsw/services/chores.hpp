// Chores: an ordinary thread that does, again and again, what real-time threads must not: writing files,
// asking the system. Nobody waits for it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace omma {

class Chores {
 public:
  /// @param period  from the end of one round to the next
  explicit Chores(std::chrono::milliseconds period) : period_(period) {}
  ~Chores() { stop(); }
  Chores(const Chores&) = delete;
  Chores& operator=(const Chores&) = delete;

  /// Before `start`. It does not throw.
  void add(std::function<void()> chore) { chores_.push_back(std::move(chore)); }
  void start();
  /// Does each chore a last time and ends the thread; without effect when it is not running.
  void stop();

 private:
  void serve();

  const std::chrono::milliseconds period_;
  std::vector<std::function<void()>> chores_;
  std::thread thread_;
  std::mutex mutex_;  // for sleeping and ending
  std::condition_variable wake_;
  bool ending_ = false;
};

}  // namespace omma
