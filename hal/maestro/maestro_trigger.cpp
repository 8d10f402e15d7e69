#include "hal/maestro/maestro_trigger.hpp"

#include "fsw/kernel/clock.hpp"

namespace omma {
namespace {

constexpr QuarterMicroseconds kHigh = 4 * 2000;
constexpr QuarterMicroseconds kLow = 4 * 1000;

}  // namespace

MaestroTrigger::MaestroTrigger(MaestroServo& board, int channel, TriggerPulse pulse, int priority)
    : board_(board), channel_(channel), pulse_(pulse), end_([this] { set(false); }, priority) {
  set(false);
}

MaestroTrigger::~MaestroTrigger() {
  while (end_.busy()) {  // no longer than a pulse
    MonotonicClock clock;
    clock.sleep_until(clock.now() + 1'000'000);
  }
}

bool MaestroTrigger::set(bool active) noexcept {
  return board_.set_target(channel_, active != pulse_.active_low ? kHigh : kLow);
}

std::optional<TimeNs> MaestroTrigger::pulse(std::uint64_t /*number*/, TimeNs /*due_ns*/) noexcept {
  if (end_.busy() || !set(true)) {
    not_sent_.fetch_add(1, std::memory_order_relaxed);
    return std::nullopt;
  }
  const TimeNs edge = MonotonicClock().now();
  end_.at(edge + pulse_.width_ns);
  return edge;
}

std::vector<std::string> MaestroTrigger::complaints() const {
  std::vector<std::string> sentences = end_.refusals();
  if (not_sent_ > 0)
    sentences.push_back("trigger on channel " + std::to_string(channel_) +
                        " of the servo board: a pulse could not be sent, " + std::to_string(not_sent_) +
                        " times");
  return sentences;
}

}  // namespace omma
