// The C library's functions that the flight side uses give the bits they gave where its recordings were
// compared: one set of bits where the machine multiplies and adds in one step (x86-64 since 2013, arm64),
// another where it does not. docs/porting.md says what follows.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

namespace omma {
namespace {

struct Function {
  const char* name;
  double low, high;  // of its argument
  std::function<double(double)> value;
  std::uint64_t fused, unfused;  // FNV-1a over the bits of a hundred thousand values
};

bool machine_fuses() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") != 0;
#else
  return sizeof(void*) == 8;
#endif
}

std::uint64_t hash(const Function& function) {
  std::mt19937_64 random(1);
  std::uint64_t hash = 14695981039346656037U;
  for (int i = 0; i < 100'000; ++i) {
    const double share = 0x1p-53 * static_cast<double>(random() >> 11);
    const double x = function.low + (function.high - function.low) * share;
    hash = (hash ^ std::bit_cast<std::uint64_t>(function.value(x))) * 1099511628211U;
  }
  return hash;
}

TEST(CLibrary, GivesTheSameBitsOnEveryMachineThatMultipliesAndAddsAlike) {
  const Function functions[] = {
      {"exp", -30, 30, [](double x) { return std::exp(x); }, 0x488b458e5c53ec3e, 0xde16922b0f6020a2},
      {"log", 1e-6, 1e3, [](double x) { return std::log(x); }, 0x26a39c052f1ee70c, 0xf7251f1effadb7ad},
      {"log1p", 0, 10, [](double x) { return std::log1p(x); }, 0xca6aa67070a872dd, 0xdc77086770478608},
      {"log10", 1e-6, 1e3, [](double x) { return std::log10(x); }, 0xfa0f62963524b26, 0x7a65dfb4e1e2abaf},
      {"pow", -3, 3, [](double x) { return std::pow(10.0, x); }, 0x5d59e084ba5604dd, 0x8c1848c363e53144},
      {"powf", -3, 3, [](double x) { return double{std::pow(10.0F, static_cast<float>(x))}; },
       0x5b5bdeb3f3e37a5, 0x5b5bdeb3f3e37a5},
      {"sin", -10, 10, [](double x) { return std::sin(x); }, 0x5611c51d75284b75, 0x72404cab5592064e},
      {"cos", -10, 10, [](double x) { return std::cos(x); }, 0x3a93c92cf19ffce7, 0x745c4d5265b31cf6},
      {"tan", -1.5, 1.5, [](double x) { return std::tan(x); }, 0xbb3d243f5a6a46c2, 0xbb3d243f5a6a46c2},
      {"asin", -1, 1, [](double x) { return std::asin(x); }, 0xee2ba4a73be3a4f3, 0xbda0dc9bee610c13},
      {"acos", -1, 1, [](double x) { return std::acos(x); }, 0xff95c59c2c0fc3b1, 0xbac199fad6ff6fc9},
      {"atan", -10, 10, [](double x) { return std::atan(x); }, 0xed279a3536269471, 0xe4c41c1f5cd651dc},
      {"atan2", -10, 10, [](double x) { return std::atan2(x, 1.3); }, 0xeb769e6e27a9cd9d, 0xc6c9f7acf0c01266},
      {"sinh", -10, 10, [](double x) { return std::sinh(x); }, 0x31e476d72065487f, 0xcf0ed8a2c1723394},
      {"asinh", -100, 100, [](double x) { return std::asinh(x); }, 0x5f456fbb76b36b20, 0x5f456fbb76b36b20},
  };
  for (const Function& function : functions) {
    const std::uint64_t found = hash(function);
    EXPECT_EQ(found, machine_fuses() ? function.fused : function.unfused)
        << function.name << std::hex << " 0x" << found;
  }
}

}  // namespace
}  // namespace omma
