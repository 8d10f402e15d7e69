// The history ring under every interleaving: a record is read whole or not at all, beside variants broken on
// purpose that the same test catches.
#include <gtest/gtest.h>

#include <memory>

#include "fsw/kernel/history_ring.hpp"
#include "tests/fsw/kernel/interleavings.hpp"

namespace omma {
namespace {

using testing::Execution;
using testing::Exploration;
using testing::ModelAtomic;

/// Whole when both halves are the same.
struct Pair {
  std::uint64_t first = 0;
  std::uint64_t second = 0;
};

template <Writers kWriters>
using ModelRing = HistoryRing<Pair, kWriters, ModelAtomic>;

/// Broken on purpose: the turn cannot be odd, so that a writer does not see that another is in its place, and
/// a reader does not see that one came in between.
template <class T>
class NeverOdd : public ModelAtomic<T> {
 public:
  using ModelAtomic<T>::ModelAtomic;
  void store(T value, std::memory_order order) { ModelAtomic<T>::store(value, order); }
  T load(std::memory_order order) const { return ModelAtomic<T>::load(order) & ~T{1}; }
  bool compare_exchange_strong(T& expected, T value, std::memory_order order) {
    ModelAtomic<T>::store(value, order);
    expected = value;
    return true;
  }
};

/// One writer goes round a ring of one while a reader looks.
template <template <class> class Atomic>
Execution one_writer() {
  struct Shared {
    HistoryRing<Pair, Writers::kOne, Atomic> ring{1};
    std::string fault;
    int read = 0;
  };
  const auto shared = std::make_shared<Shared>();
  const auto look = [shared](std::uint64_t number) {
    Pair seen;
    if (!shared->ring.read(number, seen)) return;
    ++shared->read;
    if (seen.first != seen.second) shared->fault = "a record was read half overwritten";
    if (seen.first != number + 1) shared->fault = "a record came under another's number";
  };
  return {.threads = {[shared] {
                        for (std::uint64_t n = 0; n < 2; ++n) shared->ring.put({n + 1, n + 1});
                      },
                      [look] {
                        look(0);
                        look(1);
                      }},
          .verdict = [shared, look] {
            look(1);
            if (shared->fault.empty() && shared->read == 0) return std::string("the newest record was lost");
            return shared->fault;
          }};
}

/// Two writers meet in the one place of a ring.
template <template <class> class Atomic>
Execution two_writers() {
  struct Shared {
    HistoryRing<Pair, Writers::kMany, Atomic> ring{1};
    std::string fault;
    int lost = 0;
    int read = 0;
  };
  const auto shared = std::make_shared<Shared>();
  const auto write = [shared](std::uint64_t value) {
    if (!shared->ring.put({value, value})) ++shared->lost;
  };
  return {.threads = {[write] { write(7); }, [write] { write(9); }}, .verdict = [shared] {
            for (std::uint64_t number = 0; number < 2; ++number) {
              Pair seen;
              if (!shared->ring.read(number, seen)) continue;
              ++shared->read;
              if (seen.first != seen.second) shared->fault = "two writers made one record";
            }
            if (shared->fault.empty() && shared->read != 1) return std::string("the place holds no record");
            if (shared->fault.empty() && shared->lost > 1) return std::string("both records were lost");
            return shared->fault;
          }};
}

TEST(HistoryRingModel, RecordIsReadWholeOrNotAtAllInEveryInterleaving) {
  const Exploration result = testing::explore(one_writer<ModelAtomic>);
  EXPECT_EQ(result.fault, "");
  EXPECT_GT(result.interleavings, 1000U);
}

TEST(HistoryRingModel, CatchesAReaderThatCannotSeeAWriterInBetween) {
  EXPECT_NE(testing::explore(one_writer<NeverOdd>).fault, "");
}

TEST(HistoryRingModel, WritersThatMeetLoseOneRecordAndSpoilNone) {
  const Exploration result = testing::explore(two_writers<ModelAtomic>);
  EXPECT_EQ(result.fault, "");
  EXPECT_GT(result.interleavings, 100U);
}

TEST(HistoryRingModel, CatchesWritersThatDoNotSeeEachOther) {
  EXPECT_NE(testing::explore(two_writers<NeverOdd>).fault, "");
}

}  // namespace
}  // namespace omma
