// omma-bench ports: what it costs to move a message: within a rate group, across rate groups by triple buffer
// and by queue, and by a mutex for comparison.
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <thread>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

/// About as large as an attitude estimate.
struct Message {
  std::uint64_t tick = 0;
  std::array<double, 30> values{};
};

void keep(const void* value) {
  asm volatile("" : : "g"(value) : "memory");
}

/// Time of one round, best of five [ns].
template <class Round>
double best_ns(int rounds, Round&& round) {
  std::vector<double> times;
  for (int repeat = 0; repeat < 5; ++repeat)
    times.push_back(microseconds([&] {
                      const RealTimeScope real_time;
                      for (int i = 0; i < rounds; ++i) round(static_cast<std::uint64_t>(i));
                    }) *
                    1e3 / rounds);
  return quantile(times, 0);
}

/// Half of a round trip between two threads that both poll [ns]: median over batches of a hundred trips, on
/// the wall clock.
/// @param trip   sends number i and waits for its answer
/// @param answer the other thread's part
template <class Trip, class Answer>
double half_trip_ns(int rounds, Trip&& trip, Answer&& answer) {
  constexpr std::uint64_t kBatch = 100;
  const std::uint64_t batches = static_cast<std::uint64_t>(rounds) / 20 / kBatch + 1;
  std::thread other([&] {
    for (std::uint64_t i = 1; i <= batches * kBatch; ++i) answer(i);
  });
  std::vector<double> means;
  means.reserve(batches);
  MonotonicClock clock;
  for (std::uint64_t batch = 0; batch < batches; ++batch) {
    const TimeNs start = clock.now();
    for (std::uint64_t i = 1; i <= kBatch; ++i) trip(batch * kBatch + i);
    means.push_back(static_cast<double>(clock.now() - start) / (2.0 * kBatch));
  }
  other.join();
  return quantile(means, 0.5);
}

/// The least the machine allows: a number in one cache line there, one back.
double one_line_ns(int rounds) {
  alignas(64) std::atomic<std::uint64_t> ping{0};
  alignas(64) std::atomic<std::uint64_t> pong{0};
  const auto wait = [](const std::atomic<std::uint64_t>& line, std::uint64_t number) {
    while (line.load(std::memory_order_acquire) != number) {
    }
  };
  return half_trip_ns(
      rounds,
      [&](std::uint64_t i) {
        ping.store(i, std::memory_order_release);
        wait(pong, i);
      },
      [&](std::uint64_t i) {
        wait(ping, i);
        pong.store(i, std::memory_order_release);
      });
}

double one_way_ns(int rounds) {
  Out<Message> ping;
  Out<Message> pong;
  Latest<Message> there(ping);
  Latest<Message> back(pong);
  const auto wait = [](Latest<Message>& latest, std::uint64_t number) {
    while (latest.current().tick != number) latest.acquire();
  };
  return half_trip_ns(
      rounds,
      [&](std::uint64_t i) {
        ping->tick = i;
        there.publish();
        wait(back, i);
      },
      [&](std::uint64_t i) {
        wait(there, i);
        pong->tick = i;
        back.publish();
      });
}

struct TransferCost {
  double writer_ns = 0;
  double reader_ns = 0;
};

/// What each side pays, in rate groups on two cores that meet once a beat: the writer's copy and publish, the
/// reader's acquire and its reading of the whole message, every line of which lies in the other's cache. A
/// word beside tells whose turn it is. Medians; the clock's own time is taken off.
TransferCost transfer_cost(int rounds) {
  const int turns = rounds / 20 + 1;
  alignas(64) std::atomic<int> turn{0};
  Out<Message> out;
  Latest<Message> latest(out);
  MonotonicClock clock;
  const auto wait_for = [&](int number) {
    while (turn.load(std::memory_order_acquire) != number) {
    }
  };
  std::vector<double> reader(static_cast<std::size_t>(turns));
  std::thread other([&] {
    double sum = 0;
    for (int i = 0; i < turns; ++i) {
      wait_for(2 * i + 1);
      const TimeNs start = clock.now();
      latest.acquire();
      for (const double value : latest.current().values) sum += value;
      keep(&sum);
      reader[static_cast<std::size_t>(i)] = static_cast<double>(clock.now() - start);
      turn.store(2 * i + 2, std::memory_order_release);
    }
  });
  std::vector<double> writer(static_cast<std::size_t>(turns));
  std::vector<double> nothing(static_cast<std::size_t>(turns));
  for (int i = 0; i < turns; ++i) {
    const TimeNs before = clock.now();
    nothing[static_cast<std::size_t>(i)] = static_cast<double>(clock.now() - before);
    wait_for(2 * i);
    out->tick = static_cast<std::uint64_t>(i);
    out->values.fill(i);
    const TimeNs start = clock.now();
    latest.publish();
    writer[static_cast<std::size_t>(i)] = static_cast<double>(clock.now() - start);
    turn.store(2 * i + 1, std::memory_order_release);
  }
  other.join();
  const double clock_ns = quantile(nothing, 0.5);
  return {quantile(writer, 0.5) - clock_ns, quantile(reader, 0.5) - clock_ns};
}

}  // namespace

int bench_ports(Options& options) {
  int rounds = 1'000'000;
  options.add("--rounds", rounds, "messages of each kind");
  options.read();
  Out<Message> out;
  In<Message> in;
  in.bind(out);
  double sum = 0;
  const auto write = [&](std::uint64_t i) {
    out->tick = i;
    out->values[7] = static_cast<double>(i);
    keep(&out);
  };
  const double same = best_ns(rounds, [&](std::uint64_t i) {
    write(i);
    sum += in->values[7];
  });
  Latest<Message> latest(out);
  In<Message> far;
  far.bind(latest);
  const double across = best_ns(rounds, [&](std::uint64_t i) {
    write(i);
    latest.publish();
    latest.acquire();
    keep(&latest);
    sum += far->values[7];
  });
  Queue<Message, 64> queue;
  Message received;
  const double queued = best_ns(rounds, [&](std::uint64_t i) {
    write(i);
    queue.push(*out);
    queue.pop(received);
    keep(&received);
    sum += received.values[7];
  });
  std::mutex mutex;
  Message shared;
  const double locked = best_ns(rounds, [&](std::uint64_t i) {
    write(i);
    {
      const std::lock_guard lock(mutex);
      shared = *out;
    }
    {
      const std::lock_guard lock(mutex);
      received = shared;
    }
    keep(&received);
    sum += received.values[7];
  });
  std::printf("A message of %zu bytes, written and read [ns] (checksum %g)\n", sizeof(Message), sum);
  std::printf("  same rate group (reference)        %7.1f\n", same);
  std::printf("  Latest: publish and acquire        %7.1f\n", across);
  std::printf("  Queue: push and pop                %7.1f\n", queued);
  std::printf("  mutex and two copies, uncontended  %7.1f\n", locked);
  const TransferCost cost = transfer_cost(rounds);
  std::printf("  Latest, to another core            %7.1f  (writer %.1f, reader %.1f)\n",
              cost.writer_ns + cost.reader_ns, cost.writer_ns, cost.reader_ns);
  std::printf("  the same, one way, both polling    %7.1f\n", one_way_ns(rounds));
  std::printf("  one cache line, both polling       %7.1f\n", one_line_ns(rounds));
  print_memory_touched();
  return 0;
}

}  // namespace omma
