// Who may stroke the watchdog: critical groups that meet their deadlines, and what systemd hears of it.
#include "fsw/services/life_signs.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/service_notice.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;
using testing::FakeClock;
using testing::Scripted;

/// What each look of a witness in the schedule found, when the work spends `work_ns` in a given beat.
std::vector<int> looks(bool critical, std::uint64_t slow_tick, TimeNs work_ns) {
  FakeClock clock;
  Scripted work("work", [&](const Tick& tick) {
    if (tick.number == slow_tick) clock.spend(work_ns);
  });
  LifeSigns* signs = nullptr;
  std::vector<int> found;
  Scripted witness("witness", [&](const Tick&) { found.push_back(signs->look(clock.now())); });
  Scheduler scheduler({.base_period = 1ms,
                       .groups = {{.name = "g", .critical = critical, .components = {{work}, {witness}}}}},
                      clock);
  LifeSigns life_signs(scheduler, 1'000'000, 0);
  signs = &life_signs;
  scheduler.run(8);
  return found;
}

TEST(LifeSigns, AllIsWellWhileNoBeatIsMissed) {
  EXPECT_EQ(looks(true, 3, 900'000), std::vector<int>(8, LifeSigns::kAllWell));
}

TEST(LifeSigns, MissedBeatOfACriticalGroupIsSeenOnce) {
  // Beat 3 takes 2.5 ms: beats 4 and 5 are missed, beat 6 is the next to look.
  EXPECT_EQ(looks(true, 3, 2'500'000), (std::vector<int>{-1, -1, -1, -1, 0, -1}));
}

TEST(LifeSigns, GroupsThatAreNotCriticalMayMissTheirs) {
  EXPECT_EQ(looks(false, 3, 2'500'000), std::vector<int>(6, LifeSigns::kAllWell));
}

TEST(LifeSigns, GroupThatHasStoppedIsNotWell) {
  FakeClock clock;
  Scripted work("work");
  Scheduler scheduler(
      {.base_period = 10ms, .groups = {{.name = "g", .critical = true, .components = {{work}}}}}, clock);
  LifeSigns signs(scheduler, 5'000'000, 0);
  scheduler.run(3);
  EXPECT_EQ(signs.look(22'000'000), LifeSigns::kAllWell);
  EXPECT_EQ(signs.look(47'000'000), LifeSigns::kAllWell);  // two periods and the patience
  EXPECT_EQ(signs.look(47'000'001), 0);
}

/// The listening end of a notification socket, as systemd holds it.
class Listener {
 public:
  explicit Listener(const std::string& name) : file_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy(name.begin(), name.end(), address.sun_path);
    if (name[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(bind(file_, reinterpret_cast<const sockaddr*>(&address), size), 0);
  }
  ~Listener() { close(file_); }
  std::string hear() const {
    std::array<char, 256> text{};
    const ssize_t length = recv(file_, text.data(), text.size(), 0);
    return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : "";
  }

 private:
  int file_;
};

TEST(ServiceNotice, IsHeardAtAPathAndAtAnAbstractName) {
  const std::string path = ::testing::TempDir() + "notice_" + std::to_string(getpid());
  for (const std::string& name : {path, "@omma_notice_" + std::to_string(getpid())}) {
    const Listener listener(name);
    ServiceNotice notice(name);
    EXPECT_TRUE(notice.heard());
    EXPECT_TRUE(notice.tell("READY=1\nSTATUS=flying"));
    EXPECT_EQ(listener.hear(), "READY=1\nSTATUS=flying");
  }
  unlink(path.c_str());
}

TEST(ServiceNotice, SaysNothingWhereNobodyListens) {
  EXPECT_FALSE(ServiceNotice("").tell("READY=1"));
  EXPECT_FALSE(ServiceNotice("/nowhere/notify").tell("READY=1"));
  EXPECT_FALSE(ServiceNotice(std::string(200, '/')).tell("READY=1"));
  EXPECT_FALSE(ServiceNotice("vsock:2:1234").heard());
}

TEST(ServiceNotice, NeverWaitsForAListenerThatDoesNotRead) {
  const std::string name = "@omma_deaf_" + std::to_string(getpid());
  const Listener listener(name);
  ServiceNotice notice(name);
  int heard = 0;
  while (heard < 100'000 && notice.tell("WATCHDOG=1")) ++heard;
  EXPECT_LT(heard, 100'000);  // its queue is full, and `tell` came back
}

TEST(ServiceNotice, TakesTheWatchdogPeriodThatIsMeantForThisProcess) {
  setenv("NOTIFY_SOCKET", "@somewhere", 1);
  setenv("WATCHDOG_USEC", "3000000", 1);
  EXPECT_EQ(ServiceNotice::from_environment().watchdog_ns(), 3'000'000'000);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(ServiceNotice::from_environment().watchdog_ns(), 3'000'000'000);
  setenv("WATCHDOG_PID", "1", 1);
  EXPECT_EQ(ServiceNotice::from_environment().watchdog_ns(), 0);
  setenv("WATCHDOG_USEC", "soon", 1);
  unsetenv("WATCHDOG_PID");
  EXPECT_EQ(ServiceNotice::from_environment().watchdog_ns(), 0);
  unsetenv("WATCHDOG_USEC");
  unsetenv("NOTIFY_SOCKET");
  EXPECT_FALSE(ServiceNotice::from_environment().heard());
}

}  // namespace
}  // namespace omma
