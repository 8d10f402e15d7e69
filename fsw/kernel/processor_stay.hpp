// Did this thread keep its processor from one point to another? Told without a system call, so that a step's
// processor time is known to equal its wall time, or the step is known to have been pre-empted (or to have
// waited).
// How: Linux's restartable sequences (rseq, kernel 4.18, registered for every thread by glibc 2.35). The
// kernel clears the thread's pointer to a sequence when it takes the processor away outside of that sequence;
// we point it at a sequence that is never entered and look whether the pointer still stands.
#pragma once

#include <cstdint>

namespace omma {

/// Belongs to the thread that made it.
class ProcessorStay {
 public:
  ProcessorStay() noexcept;
  ~ProcessorStay() { end(); }
  ProcessorStay(const ProcessorStay&) = delete;
  ProcessorStay& operator=(const ProcessorStay&) = delete;

  /// False where the machine cannot tell; `unbroken` is then always false.
  bool available() const noexcept { return sequence_ != nullptr; }
  void begin() noexcept {
    if (sequence_ != nullptr) *sequence_ = never_entered();
  }
  /// True when the thread ran on without a break since `begin`.
  bool unbroken() const noexcept { return sequence_ != nullptr && *sequence_ != 0; }
  void end() noexcept {
    if (sequence_ != nullptr) *sequence_ = 0;
  }

 private:
  static std::uint64_t never_entered() noexcept;

  volatile std::uint64_t* sequence_ = nullptr;  // the thread's rseq_cs, written by the kernel too
};

}  // namespace omma
