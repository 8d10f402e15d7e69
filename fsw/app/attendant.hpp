// Attends to devices on an ordinary thread, beside real time: opens again what was unplugged, asks for
// errors.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace omma {

class Attendant {
 public:
  Attendant() = default;
  ~Attendant() { stop(); }
  Attendant(const Attendant&) = delete;
  Attendant& operator=(const Attendant&) = delete;

  /// Before `start`: what is done again and again, every kPause. It must not throw.
  void add(std::function<void()> duty) { duties_.push_back(std::move(duty)); }
  /// Does nothing where there are no duties.
  void start();
  void stop();

 private:
  static constexpr std::chrono::milliseconds kPause{250};
  void run();

  std::vector<std::function<void()>> duties_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace omma
