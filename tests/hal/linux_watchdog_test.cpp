// The Linux watchdog: what is no watchdog is refused in a sentence; with OMMA_WATCHDOG naming a device
// (softdog in a virtual machine, say) its time-out, stroke and magic close.
#include "hal/linux_watchdog/linux_watchdog.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "fsw/kernel/input_error.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

std::string refusal(const std::string& device, int timeout_s) {
  return refusal_of([&] { LinuxWatchdog watchdog(device, timeout_s); });
}

TEST(LinuxWatchdog, RefusesWhatIsNoWatchdogInASentence) {
  EXPECT_EQ(
      refusal("/nowhere/watchdog", 10),
      "/nowhere/watchdog: watchdog: expected a device that can be opened, found No such file or directory");
  // What the device is instead is the kernel's to say: an emulator says it in other words.
  EXPECT_EQ(refusal("/dev/null", 10).rfind("/dev/null: watchdog: expected a watchdog device, found ", 0), 0U);
}

class RealWatchdog : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const named = std::getenv("OMMA_WATCHDOG");
    if (named == nullptr) GTEST_SKIP() << "OMMA_WATCHDOG names no device";
    device = named;
  }
  /// As sysfs tells it: the driver's own view.
  static std::string attribute(const char* name) {
    std::ifstream in(std::string("/sys/class/watchdog/watchdog0/") + name);
    std::string value;
    std::getline(in, value);
    return value;
  }

  std::string device;
};

TEST_F(RealWatchdog, KeepsTheTimeoutAskedForAndIsDisarmedByTheMagicClose) {
  LinuxWatchdog watchdog(device, 7);
  EXPECT_EQ(watchdog.timeout(), 7'000'000'000);
  EXPECT_NE(watchdog.identity(), "");
  EXPECT_EQ(attribute("state"), "active");
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_TRUE(watchdog.stroke());
  }
  EXPECT_TRUE(watchdog.disarm());
  EXPECT_FALSE(watchdog.stroke());
  EXPECT_EQ(attribute("state"), "inactive");
}

TEST_F(RealWatchdog, RefusesATimeoutTheDeviceCannotKeepAndIsDisarmed) {
  EXPECT_NE(refusal(device, 10'000'000).find("watchdog timeout: expected a time-out that "),
            std::string::npos);
  EXPECT_EQ(attribute("state"), "inactive");
}

}  // namespace
}  // namespace omma
