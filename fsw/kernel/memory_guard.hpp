// Memory guard: counts what a real-time stretch of a thread (RealTimeScope) must not do: allocate, give
// back, map memory. The counters are here; what bumps them is the library omma_memory_guard, which a
// program links to replace malloc and its family and mmap. Without it, or under a sanitizer, which has
// its own malloc, nothing is counted and `installed` is false.
#pragma once

#include <atomic>
#include <cstdint>

namespace omma::memory_guard {

enum class Reaction : std::uint8_t {
  kCount,  ///< flight: counted, raised as an event by whoever looks
  kAbort,  ///< tests and debuggers: the program stops where it happened
};

struct Violations {
  std::uint64_t allocations = 0;  ///< malloc, calloc, realloc, aligned forms, operator new
  std::uint64_t releases = 0;     ///< free, operator delete
  std::uint64_t mappings = 0;     ///< mmap, munmap, mremap

  std::uint64_t total() const { return allocations + releases + mappings; }
};

namespace detail {
inline constinit std::atomic<std::uint64_t> allocations{0};
inline constinit std::atomic<std::uint64_t> releases{0};
inline constinit std::atomic<std::uint64_t> mappings{0};
inline constinit std::atomic<Reaction> reaction{Reaction::kCount};
inline constinit std::atomic<bool> installed{false};
}  // namespace detail

/// True when the guard is linked into this program.
inline bool installed() noexcept {
  return detail::installed.load(std::memory_order_relaxed);
}

inline void react_by(Reaction reaction) noexcept {
  detail::reaction.store(reaction, std::memory_order_relaxed);
}

/// All threads together, since the program started.
inline Violations violations() noexcept {
  return {detail::allocations.load(std::memory_order_relaxed),
          detail::releases.load(std::memory_order_relaxed), detail::mappings.load(std::memory_order_relaxed)};
}

}  // namespace omma::memory_guard
