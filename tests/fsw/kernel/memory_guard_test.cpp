// The guard sees every way to get memory inside a real-time stretch, and nothing outside one.
#include "fsw/kernel/memory_guard.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "fsw/kernel/real_time_scope.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/kernel/worker_pool.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

// The compiler may not remove an allocation whose address it cannot follow.
void keep(void* memory) {
  asm volatile("" : : "g"(memory) : "memory");
}

class MemoryGuard : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!memory_guard::installed()) GTEST_SKIP() << "the guard is off under this sanitizer";
  }

  static memory_guard::Violations violations_of(const std::function<void()>& action) {
    const memory_guard::Violations before = memory_guard::violations();
    {
      const RealTimeScope real_time;
      action();
    }
    const memory_guard::Violations after = memory_guard::violations();
    return {after.allocations - before.allocations, after.releases - before.releases,
            after.mappings - before.mappings};
  }
};

TEST_F(MemoryGuard, SeesEveryWayToAllocate) {
  const std::function<void*()> ways[] = {
      [] { return std::malloc(10); },
      [] { return std::calloc(3, 10); },
      [] { return std::realloc(nullptr, 10); },
      [] { return std::aligned_alloc(64, 128); },
      [] {
        void* memory = nullptr;
        if (posix_memalign(&memory, 64, 10) != 0) memory = nullptr;
        return memory;
      },
      [] { return ::operator new(10); },
      [] { return ::operator new (128, std::align_val_t{64}); },
  };
  for (std::size_t i = 0; i < std::size(ways); ++i) {
    void* memory = nullptr;
    EXPECT_EQ(violations_of([&] {
                memory = ways[i]();
                keep(memory);
              }).allocations,
              1U)
        << "way " << i;
    EXPECT_EQ(violations_of([&] { std::free(memory); }).releases, 1U);
  }
}

TEST_F(MemoryGuard, SeesMappings) {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS;
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::function<void*()> ways[] = {
      [&] { return mmap(nullptr, page, PROT_READ, kFlags, -1, 0); },
      [&] { return mmap64(nullptr, page, PROT_READ, kFlags, -1, 0); },
  };
  for (const auto& way : ways) {
    void* memory = nullptr;
    EXPECT_EQ(violations_of([&] { memory = way(); }).mappings, 1U);
    ASSERT_NE(memory, MAP_FAILED);
    EXPECT_EQ(violations_of([&] { memory = mremap(memory, page, 2 * page, MREMAP_MAYMOVE); }).mappings, 1U);
    ASSERT_NE(memory, MAP_FAILED);
    EXPECT_EQ(violations_of([&] { munmap(memory, 2 * page); }).mappings, 1U);
  }
}

TEST_F(MemoryGuard, MapsWhatTheCLibraryWould) {
  std::FILE* const file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  // The third page of the file, and one that needs an offset of more than 32 bits; qemu-arm 7.2 forgets its
  // upper bits, whoever asks.
  const char* const launcher = std::getenv("OMMA_LAUNCHER");
  const bool emulated = launcher != nullptr && *launcher != '\0';
  for (const off64_t offset : {off64_t(2 * page), off64_t{5} << 30}) {
    if (emulated && sizeof(void*) == 4 && offset > 1'000'000) break;
    const char letter = offset < 1'000'000 ? 'a' : 'b';
    ASSERT_EQ(pwrite64(fileno(file), &letter, 1, offset), 1);
    void* const memory = mmap64(nullptr, page, PROT_READ, MAP_SHARED, fileno(file), offset);
    ASSERT_NE(memory, MAP_FAILED);
    EXPECT_EQ(*static_cast<const char*>(memory), letter);
    void* const moved = mremap(memory, page, page, MREMAP_MAYMOVE);
    ASSERT_NE(moved, MAP_FAILED);
    // A place of one's own choice.
    void* const place = mmap(nullptr, page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    EXPECT_EQ(mremap(moved, page, page, MREMAP_MAYMOVE | MREMAP_FIXED, place), place);
    EXPECT_EQ(*static_cast<const char*>(place), letter);
    munmap(place, page);
  }
  errno = 0;
  EXPECT_EQ(mmap64(nullptr, page, PROT_READ, MAP_SHARED, fileno(file), 17), MAP_FAILED);
  EXPECT_EQ(errno, EINVAL);
  std::fclose(file);
}

TEST_F(MemoryGuard, DoesNotMindWhatHappensOutsideARealTimeStretch) {
  const auto before = memory_guard::violations().total();
  const auto text = std::make_unique<std::string>(1000, 'x');
  EXPECT_EQ(text->size(), 1000U);
  // Another thread's allocation is its own affair.
  const RealTimeScope real_time;
  EXPECT_EQ(memory_guard::violations().total(), before);
}

TEST_F(MemoryGuard, StopsTheProgramWhereItHappenedWhenAskedTo) {
  EXPECT_DEATH(
      {
        memory_guard::react_by(memory_guard::Reaction::kAbort);
        const RealTimeScope real_time;
        keep(std::malloc(1));
      },
      "memory allocated, released or mapped inside a real-time step");
}

TEST_F(MemoryGuard, SeesAComponentThatAllocatesInItsStep) {
  std::vector<std::vector<int>> growing;
  testing::Scripted guilty("guilty", [&](const Tick&) { growing.emplace_back(100); });
  LockstepClock clock;
  Scheduler scheduler({.base_period = 1ms, .groups = {{.name = "g", .components = {{guilty}}}}}, clock);
  const auto before = memory_guard::violations();
  scheduler.run(10);
  EXPECT_GE(memory_guard::violations().allocations - before.allocations, 10U);
}

TEST_F(MemoryGuard, SchedulerCrossingsAndPoolAllocateNothingInARealTimeRun) {
  MonotonicClock clock;
  testing::Source source;
  testing::Sink sink;
  sink.seen.reserve(300);
  Latest<testing::Number> number_for_sink(source.number);
  sink.number.bind(number_for_sink);
  WorkerPool pool(3);
  std::atomic<int> jobs{0};
  testing::Scripted splitter("splitter", [&](const Tick&) { pool.run(6, [&](int) { jobs.fetch_add(1); }); });
  Scheduler scheduler(
      {.base_period = 500us,
       .groups = {{.name = "fast", .components = {{source, 1ns}}},
                  {.name = "slow", .divisor = 3, .components = {{splitter, 1ns}, {sink, 1ns}}}}},
      clock);
  const auto before = memory_guard::violations().total();
  scheduler.run(300);
  EXPECT_GT(jobs.load(), 0);
  EXPECT_GT(sink.seen.back(), 0);
  EXPECT_EQ(memory_guard::violations().total(), before);
}

}  // namespace
}  // namespace omma
