// Page faults of a real-time thread are counted, each page once; an undisturbed run has none.
#include "fsw/kernel/page_faults.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/health.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

/// Memory that is mapped but not there yet, a page to touch at a time.
class Untouched {
 public:
  explicit Untouched(std::size_t pages)
      : size_(pages * page_),
        memory_(static_cast<char*>(mmap(nullptr, size_, PROT_READ | PROT_WRITE,
                                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0))) {
    madvise(memory_, size_, MADV_NOHUGEPAGE);
  }
  ~Untouched() { munmap(memory_, size_); }
  Untouched(const Untouched&) = delete;
  Untouched& operator=(const Untouched&) = delete;
  void touch(std::size_t page) { static_cast<volatile char*>(memory_)[page * page_] = 1; }

 private:
  std::size_t page_ = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::size_t size_;
  char* memory_;
};

/// Under an emulator its own memory counts too.
bool emulated() {
  const char* const launcher = std::getenv("OMMA_LAUNCHER");
  return launcher != nullptr && *launcher != '\0';
}

TEST(PageFaults, AreCountedExactlyByTheThreadAndFromOutside) {
  Untouched memory(100);
  PageFaults faults;
  std::thread([&] {
    faults.begin();
    for (std::size_t page = 0; page < 40; ++page) memory.touch(page);
    std::thread([&] { faults.sample(); }).join();
    EXPECT_GE(faults.count(), 40U);
    for (std::size_t page = 40; page < 100; ++page) memory.touch(page);
    faults.end();
  }).join();
  EXPECT_GE(faults.count(), 100U);
  if (!emulated()) {
    EXPECT_LT(faults.count(), 150U);  // starting a thread inside takes a few
  }
  const std::uint64_t all = faults.count();
  faults.sample();  // the thread is gone
  EXPECT_EQ(faults.count(), all);
}

/// Faults of 400 beats in which `touch` is called.
template <class Touch>
std::uint64_t faults_of_run(Touch&& touch) {
  testing::Source source;
  testing::Sink sink;
  sink.seen.reserve(400);
  for (int i = 0; i < 400; ++i) sink.seen.push_back(0);
  sink.seen.clear();
  sink.number.bind(source.number);
  testing::Scripted toucher("toucher", touch);
  MonotonicClock clock;
  Scheduler scheduler(
      {.base_period = 500us, .groups = {{.name = "g", .components = {{source}, {toucher}, {sink}}}}}, clock);
  scheduler.run(400);
  return scheduler.group(0).page_faults().count();
}

TEST(PageFaults, OfARunAreNoneWhenAllMemoryIsThere) {
  // The first run brings in the program's own pages; a machine short of memory may take some away again.
  std::uint64_t fewest = faults_of_run([](const Tick&) {});
  for (int i = 0; i < 4 && fewest > 0; ++i) fewest = std::min(fewest, faults_of_run([](const Tick&) {}));
  EXPECT_EQ(fewest, 0U);
}

TEST(PageFaults, OfAComponentThatTouchesNewMemoryAreSeen) {
  Untouched memory(400);
  faults_of_run([](const Tick&) {});
  std::uint64_t touched = 0;
  const std::uint64_t faults = faults_of_run([&](const Tick& tick) {
    memory.touch(tick.number);
    ++touched;
  });
  EXPECT_GE(faults, touched);
  if (!emulated()) {
    EXPECT_LE(faults, touched + 20);
  }
}

TEST(PageFaults, RaiseAnEventInFlight) {
  Untouched memory(20000);
  Events events;
  Health health(events);
  std::atomic<bool> told{false};
  Scheduler* running = nullptr;
  testing::Scripted toucher("toucher", [&](const Tick& tick) {
    if (tick.number < 20000) memory.touch(tick.number);
  });
  testing::Scripted watch("watch", [&](const Tick& tick) {
    EventRecord record;
    while (events.take(record)) told = told || record.id == kPageFaulted.id;
    if (told || tick.number > 20000) running->stop();
  });
  MonotonicClock clock;
  Scheduler scheduler(
      {.base_period = 500us, .groups = {{.name = "g", .components = {{toucher}, {health}, {watch}}}}}, clock);
  health.observe(scheduler);
  running = &scheduler;
  scheduler.run();
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace omma
