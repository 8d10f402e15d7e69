// Exhaustive model of lock-free code: runs the real template, with its atomics replaced by ModelAtomic, under
// every interleaving of its threads (sequentially consistent steps; weaker orders are the thread sanitizer's
// matter). Threads are fibres that hand over at each access, so an execution is repeatable; all choices are
// walked depth first.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace omma::testing {

/// One run: its threads on fresh shared state, and what was wrong in the end ("" for nothing).
struct Execution {
  std::vector<std::function<void()>> threads;
  std::function<std::string()> verdict;
};

struct Exploration {
  std::size_t interleavings = 0;
  std::string fault;  ///< of the first bad interleaving, with the order of threads; exploration stops there
};

/// @param make  gives the same threads on fresh state each time
Exploration explore(const std::function<Execution()>& make);

/// A place where another thread may run; called by ModelAtomic and by values that want to be seen torn.
void step_of_model();

/// Stands in for std::atomic: each access is one step of the model.
template <class T>
class ModelAtomic {
 public:
  ModelAtomic(T value = T{}) : value_(value) {}  // NOLINT: as std::atomic
  T load(std::memory_order) const {
    step_of_model();
    return value_;
  }
  void store(T value, std::memory_order) {
    step_of_model();
    value_ = value;
  }
  T exchange(T value, std::memory_order) {
    step_of_model();
    const T before = value_;
    value_ = value;
    return before;
  }
  T fetch_add(T value, std::memory_order) {
    step_of_model();
    const T before = value_;
    value_ += value;
    return before;
  }
  bool compare_exchange_strong(T& expected, T value, std::memory_order) {
    step_of_model();
    const bool same = value_ == expected;
    if (same)
      value_ = value;
    else
      expected = value_;
    return same;
  }

 private:
  T value_;
};

/// A message that can be caught half written or half read.
struct Halves {
  int first = 0;
  int second = 0;

  Halves() = default;
  explicit Halves(int value) : first(value), second(value) {}
  Halves(const Halves& other) { *this = other; }
  Halves& operator=(const Halves& other) {
    first = other.first;
    step_of_model();
    second = other.second;
    return *this;
  }
  bool whole() const { return first == second; }
};

}  // namespace omma::testing
