// omma-bench ports: what it costs to move a message: within a rate group, across rate groups by triple buffer
// and by queue, and by a mutex for comparison. Options: --rounds N.
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <thread>

#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/port.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"

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
                      for (int i = 0; i < rounds; ++i) round(static_cast<std::uint64_t>(i));
                    }) *
                    1e3 / rounds);
  return quantile(times, 0);
}

/// Half of a round trip between two threads that both poll, median [ns].
double one_way_ns(int rounds) {
  Out<Message> ping;
  Out<Message> pong;
  Latest<Message> there(ping);
  Latest<Message> back(pong);
  const int trips = rounds / 20;
  std::thread other([&] {
    for (std::uint64_t i = 1; i <= static_cast<std::uint64_t>(trips); ++i) {
      while (there.current().tick != i) there.acquire();
      pong->tick = i;
      back.publish();
    }
  });
  std::vector<double> trip_us;
  trip_us.reserve(static_cast<std::size_t>(trips));
  for (std::uint64_t i = 1; i <= static_cast<std::uint64_t>(trips); ++i)
    trip_us.push_back(microseconds([&] {
      ping->tick = i;
      there.publish();
      while (back.current().tick != i) back.acquire();
    }));
  other.join();
  return quantile(trip_us, 0.5) * 1e3 / 2;
}

}  // namespace

int bench_ports(int argc, char** argv) {
  const int rounds = option(argc, argv, "--rounds", 1'000'000);
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
  std::printf("  Latest, to another core, one way   %7.1f\n", one_way_ns(rounds));
  return 0;
}

}  // namespace omma
