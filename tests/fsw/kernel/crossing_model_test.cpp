// Triple buffer and queue under every interleaving of one writer and one reader, each beside a broken variant
// that the same test catches.
#include <gtest/gtest.h>

#include <memory>

#include "fsw/kernel/spsc_queue.hpp"
#include "fsw/kernel/triple_buffer.hpp"
#include "tests/fsw/kernel/interleavings.hpp"

namespace omma {
namespace {

using testing::Execution;
using testing::Exploration;
using testing::Halves;
using testing::ModelAtomic;

/// Broken on purpose: the exchange is a load and a store, with room for the other thread between.
template <class T>
class TornExchange : public ModelAtomic<T> {
 public:
  using ModelAtomic<T>::ModelAtomic;
  T exchange(T value, std::memory_order order) {
    const T before = this->load(order);
    this->store(value, order);
    return before;
  }
};

template <template <class> class Atomic>
Execution newest_value() {
  struct Shared {
    TripleBuffer<Halves, Atomic> buffer;
    std::string fault;
    int last = 0;
  };
  const auto shared = std::make_shared<Shared>();
  const auto read = [shared] {
    const bool fresh = shared->buffer.acquire();
    const Halves seen = shared->buffer.front();
    if (!seen.whole()) shared->fault = "a value was read half written";
    if (fresh && seen.first <= shared->last) shared->fault = "an old value came as new";
    if (!fresh && seen.first != shared->last) shared->fault = "the value changed under the reader";
    shared->last = seen.first;
  };
  return {.threads = {[shared] {
                        for (int value = 1; value <= 2; ++value) {
                          shared->buffer.back() = Halves(value);
                          shared->buffer.publish();
                        }
                      },
                      [read] {
                        for (int i = 0; i < 3; ++i) read();
                      }},
          .verdict = [shared, read] {
            read();
            if (shared->fault.empty() && shared->last != 2) return std::string("the newest value was lost");
            return shared->fault;
          }};
}

TEST(TripleBufferModel, GivesWholeAndNewestValuesInEveryInterleaving) {
  const Exploration result = testing::explore(newest_value<ModelAtomic>);
  EXPECT_EQ(result.fault, "");
  EXPECT_GT(result.interleavings, 1000U);
}

TEST(TripleBufferModel, CatchesAnExchangeThatIsNotAtomic) {
  EXPECT_NE(testing::explore(newest_value<TornExchange>).fault, "");
}

template <class T, std::size_t kCapacity>
using ModelQueue = SpscQueue<T, kCapacity, ModelAtomic>;

/// Broken on purpose: says that a message is there before it is.
template <class T, std::size_t kCapacity>
class HastyQueue {
 public:
  explicit HastyQueue(std::uint32_t origin) : written_(origin), read_(origin) {}
  bool push(const T& message) {
    const std::uint32_t at = written_.load(std::memory_order_relaxed);
    if (at - read_.load(std::memory_order_acquire) == kCapacity) return false;
    written_.store(at + 1, std::memory_order_release);
    slots_[at % kCapacity] = message;
    return true;
  }
  bool pop(T& message) {
    const std::uint32_t at = read_.load(std::memory_order_relaxed);
    if (at == written_.load(std::memory_order_acquire)) return false;
    message = slots_[at % kCapacity];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<T, kCapacity> slots_{};
  ModelAtomic<std::uint32_t> written_;
  ModelAtomic<std::uint32_t> read_;
};

template <template <class, std::size_t> class QueueUnderTest>
Execution every_message() {
  struct Shared {
    QueueUnderTest<Halves, 2> queue{0xffffffffU};  // the counters wrap at the first message
    std::vector<int> sent;
    std::vector<int> received;
    std::string fault;
  };
  const auto shared = std::make_shared<Shared>();
  const auto receive = [shared] {
    Halves message;
    if (!shared->queue.pop(message)) return false;
    if (!message.whole()) shared->fault = "a message was read half written";
    shared->received.push_back(message.first);
    return true;
  };
  return {.threads = {[shared] {
                        for (int value = 1; value <= 3; ++value)
                          if (shared->queue.push(Halves(value))) shared->sent.push_back(value);
                      },
                      [receive] {
                        for (int i = 0; i < 2; ++i) receive();
                      }},
          .verdict = [shared, receive] {
            while (receive()) {
            }
            if (shared->fault.empty() && shared->sent != shared->received)
              return std::string("a message was lost, doubled or out of order");
            return shared->fault;
          }};
}

TEST(SpscQueueModel, BringsEveryMessageWholeAndInOrderInEveryInterleaving) {
  const Exploration result = testing::explore(every_message<ModelQueue>);
  EXPECT_EQ(result.fault, "");
  EXPECT_GT(result.interleavings, 1000U);
}

TEST(SpscQueueModel, CatchesAQueueThatAnnouncesBeforeItWrites) {
  EXPECT_NE(testing::explore(every_message<HastyQueue>).fault, "");
}

}  // namespace
}  // namespace omma
