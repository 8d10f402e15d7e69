// The restartable sequence that is never entered.
#include "fsw/kernel/processor_stay.hpp"

#include <cstddef>

#if __has_include(<sys/rseq.h>)
#include <sys/rseq.h>
#endif

namespace omma {

#if defined(RSEQ_SIG)

namespace {

/// The kernel wants its signature in front of the address where an interrupted sequence would go on; nobody
/// ever goes there.
struct Signature {
  std::uint32_t signature;
  std::uint32_t never_reached;
};
constexpr Signature kSignature{RSEQ_SIG, 0};

/// As struct rseq_cs of the kernel's interface.
struct alignas(32) Sequence {
  std::uint32_t version;
  std::uint32_t flags;
  std::uint64_t start;
  std::uint64_t length;
  std::uint64_t abort;
};

}  // namespace

ProcessorStay::ProcessorStay() noexcept {
  if (__rseq_size == 0) return;
  auto* const area = static_cast<char*>(__builtin_thread_pointer()) + __rseq_offset;
  sequence_ = reinterpret_cast<volatile std::uint64_t*>(area + offsetof(struct rseq, rseq_cs));
}

std::uint64_t ProcessorStay::never_entered() noexcept {
  // One byte of data: the program counter is never in it.
  static const Sequence sequence{0, 0, reinterpret_cast<std::uint64_t>(&kSignature.signature), 1,
                                 reinterpret_cast<std::uint64_t>(&kSignature.never_reached)};
  return reinterpret_cast<std::uint64_t>(&sequence);
}

#else

ProcessorStay::ProcessorStay() noexcept = default;
std::uint64_t ProcessorStay::never_entered() noexcept {
  return 0;
}

#endif

}  // namespace omma
