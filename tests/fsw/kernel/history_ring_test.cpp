// The history ring: what it keeps, and what its readers see while threads write.
#include "fsw/kernel/history_ring.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace omma {
namespace {

struct Record {
  std::uint64_t value = 0;
  std::uint64_t twice = 0;
  std::uint64_t thrice = 0;
};

TEST(HistoryRing, KeepsTheNewestAndForgetsTheOldest) {
  HistoryRing<Record, Writers::kOne> ring(4);
  for (std::uint64_t n = 0; n < 10; ++n) EXPECT_TRUE(ring.put({n, 2 * n, 3 * n}));
  EXPECT_EQ(ring.written(), 10U);
  EXPECT_EQ(ring.oldest(), 6U);
  Record record;
  EXPECT_FALSE(ring.read(5, record));
  for (std::uint64_t n = 6; n < 10; ++n) {
    ASSERT_TRUE(ring.read(n, record));
    EXPECT_EQ(record.thrice, 3 * n);
  }
  EXPECT_FALSE(ring.read(10, record));
}

TEST(HistoryRing, ReaderSeesWholeRecordsWhileThreadsWrite) {
  HistoryRing<Record, Writers::kMany> ring(8);
  std::atomic<int> writing{2};
  std::vector<std::thread> threads;
  for (std::uint64_t writer = 0; writer < 2; ++writer)
    threads.emplace_back([&, writer] {
      for (std::uint64_t n = 0; n < 20'000; ++n) {
        const std::uint64_t value = 2 * n + writer;
        ring.put({value, 2 * value, 3 * value});
      }
      writing.fetch_sub(1);
    });
  std::uint64_t torn = 0;
  while (writing.load() > 0) {
    const std::uint64_t end = ring.written();
    Record record;
    for (std::uint64_t number = ring.oldest(); number < end; ++number)
      if (ring.read(number, record))
        torn += record.twice != 2 * record.value || record.thrice != 3 * record.value ? 1 : 0;
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(ring.written(), 40'000U);
}

}  // namespace
}  // namespace omma
