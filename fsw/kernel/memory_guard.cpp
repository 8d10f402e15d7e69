// The guard's replacements for malloc and its family and for mmap: each notes a violation when the calling
// thread is inside a RealTimeScope, then does what it always did. operator new and delete come here through
// malloc and free. The allocator underneath is glibc's own, by its exported names, so nothing is looked up.
#include "fsw/kernel/memory_guard.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define OMMA_GUARD_OFF
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define OMMA_GUARD_OFF
#endif
#endif

#if !defined(OMMA_GUARD_OFF) && defined(__GLIBC__)

#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdlib>

#include "fsw/kernel/real_time_scope.hpp"

// glibc's names, not ours.
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" {
void* __libc_malloc(std::size_t);
void __libc_free(void*);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

void note(std::atomic<std::uint64_t>& counter) noexcept {
  if (!omma::RealTimeScope::active()) return;
  counter.fetch_add(1, std::memory_order_relaxed);
  if (omma::memory_guard::detail::reaction.load(std::memory_order_relaxed) ==
      omma::memory_guard::Reaction::kAbort) {
    constexpr char kSentence[] = "omma: memory allocated, released or mapped inside a real-time step\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kSentence, sizeof kSentence - 1);
    std::abort();
  }
}

// 32-bit machines have mmap2 instead, which counts the offset in units of 4096 bytes.
void* map_pages(void* address, std::size_t length, int protection, int flags, int file,
                off64_t offset) noexcept {
#ifdef SYS_mmap2
  constexpr off64_t kUnit = 4096;
  if (offset % kUnit != 0 || offset < 0 || offset / kUnit > off64_t{0xFFFFFFFF}) {
    errno = offset % kUnit != 0 ? EINVAL : EOVERFLOW;
    return MAP_FAILED;
  }
  return reinterpret_cast<void*>(syscall(SYS_mmap2, address, length, protection, flags, file,
                                         static_cast<unsigned long>(offset / kUnit)));
#else
  return reinterpret_cast<void*>(syscall(SYS_mmap, address, length, protection, flags, file, offset));
#endif
}

[[maybe_unused]] const bool present = [] {
  omma::memory_guard::detail::installed.store(true, std::memory_order_relaxed);
  return true;
}();

using omma::memory_guard::detail::allocations;
using omma::memory_guard::detail::mappings;
using omma::memory_guard::detail::releases;

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  note(allocations);
  return __libc_malloc(size);
}

void free(void* memory) noexcept {
  if (memory != nullptr) note(releases);
  __libc_free(memory);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  note(allocations);
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  note(allocations);
  return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  note(allocations);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  note(allocations);
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  note(allocations);
  if (alignment < sizeof(void*) || (alignment & (alignment - 1)) != 0) return EINVAL;
  void* const block = __libc_memalign(alignment, size);
  if (block == nullptr) return ENOMEM;
  *memory = block;
  return 0;
}

void* mmap(void* address, std::size_t length, int protection, int flags, int file, off_t offset) noexcept {
  note(mappings);
  return map_pages(address, length, protection, flags, file, offset);
}

// What large-file programs call mmap by, on 32-bit machines with an offset of 64 bits.
void* mmap64(void* address, std::size_t length, int protection, int flags, int file,
             off64_t offset) noexcept {
  note(mappings);
  return map_pages(address, length, protection, flags, file, offset);
}

void* mremap(void* address, std::size_t length, std::size_t new_length, int flags, ...) noexcept {
  note(mappings);
  void* place = nullptr;
  if ((flags & MREMAP_FIXED) != 0) {
    va_list more;
    va_start(more, flags);
    place = va_arg(more, void*);  // NOLINT(clang-analyzer-valist.Uninitialized): it is begun above
    va_end(more);
  }
  return reinterpret_cast<void*>(syscall(SYS_mremap, address, length, new_length, flags, place));
}

int munmap(void* address, std::size_t length) noexcept {
  note(mappings);
  return static_cast<int>(syscall(SYS_munmap, address, length));
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)

#endif
