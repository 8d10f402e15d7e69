// Triple buffer and queue between two real threads; under the thread sanitizer this also proves the memory
// orders, and a variant with the orders left out is caught.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <thread>

#include "fsw/kernel/spsc_queue.hpp"
#include "fsw/kernel/triple_buffer.hpp"

namespace omma {
namespace {

/// Large enough to be copied in many instructions.
struct Block {
  std::array<std::uint64_t, 32> words{};

  static Block of(std::uint64_t value) {
    Block block;
    block.words.fill(value);
    return block;
  }
  bool whole() const {
    for (const std::uint64_t word : words)
      if (word != words[0]) return false;
    return true;
  }
};

/// Broken on purpose: every access is relaxed, whatever was asked for.
template <class T>
class RelaxedAtomic {
 public:
  RelaxedAtomic(T value) : value_(value) {}  // NOLINT: as std::atomic
  T load(std::memory_order) const { return value_.load(std::memory_order_relaxed); }
  void store(T value, std::memory_order) { value_.store(value, std::memory_order_relaxed); }
  T exchange(T value, std::memory_order) { return value_.exchange(value, std::memory_order_relaxed); }

 private:
  std::atomic<T> value_;
};

/// Values that came torn or out of order.
template <template <class> class Atomic>
int faults_of_triple_buffer(std::uint64_t rounds) {
  TripleBuffer<Block, Atomic> buffer;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= rounds; ++i) {
      buffer.back() = Block::of(i);
      buffer.publish();
    }
  });
  int faults = 0;
  for (std::uint64_t last = 0; last < rounds;) {
    if (!buffer.acquire()) {
      std::this_thread::yield();
      continue;
    }
    const std::uint64_t value = buffer.front().words[0];
    if (!buffer.front().whole() || value <= last) ++faults;
    last = value;
  }
  writer.join();
  return faults;
}

template <template <class> class Atomic>
int faults_of_queue(std::uint64_t rounds) {
  SpscQueue<Block, 8, Atomic> queue(0xffffff00U);
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= rounds;) {
      if (queue.push(Block::of(i)))
        ++i;
      else
        std::this_thread::yield();
    }
  });
  int faults = 0;
  Block block;
  for (std::uint64_t expected = 1; expected <= rounds;) {
    if (!queue.pop(block)) {
      std::this_thread::yield();
      continue;
    }
    if (!block.whole() || block.words[0] != expected) ++faults;
    ++expected;
  }
  writer.join();
  return faults;
}

TEST(TripleBuffer, NeverGivesATornOrOlderValueBetweenThreads) {
  EXPECT_EQ(faults_of_triple_buffer<std::atomic>(100'000), 0);
}

TEST(SpscQueue, BringsEveryMessageInOrderBetweenThreads) {
  EXPECT_EQ(faults_of_queue<std::atomic>(100'000), 0);
}

#if defined(__SANITIZE_THREAD__)
TEST(TripleBuffer, SanitizerCatchesTheVariantWithoutMemoryOrders) {
  EXPECT_EXIT(std::exit(faults_of_triple_buffer<RelaxedAtomic>(2'000) * 0), ::testing::ExitedWithCode(66),
              "data race");
}

TEST(SpscQueue, SanitizerCatchesTheVariantWithoutMemoryOrders) {
  EXPECT_EXIT(std::exit(faults_of_queue<RelaxedAtomic>(2'000) * 0), ::testing::ExitedWithCode(66),
              "data race");
}
#endif

}  // namespace
}  // namespace omma
