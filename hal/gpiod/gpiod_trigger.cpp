#include "hal/gpiod/gpiod_trigger.hpp"

#include <gpiod.h>

#include <cerrno>
#include <charconv>
#include <cstring>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr const char* kConsumer = "omma frame sync";

/// A line by its number, or by its name.
gpiod_line* find_line(gpiod_chip* chip, const std::string& line) {
  unsigned offset = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), offset);
  if (error == std::errc{} && end == line.data() + line.size()) return gpiod_chip_get_line(chip, offset);
  return gpiod_chip_find_line(chip, line.c_str());
}

}  // namespace

GpiodTrigger::GpiodTrigger(const GpiodOptions& options)
    : options_(options), end_([this] { set(false); }, options_.priority) {
  if (const std::optional<Fault> fault = open())
    throw InputError("trigger", 0, fault->field, fault->expected, fault->found);
}

GpiodTrigger::~GpiodTrigger() {
  while (end_.busy()) {  // no longer than a pulse
    MonotonicClock clock;
    clock.sleep_until(clock.now() + 1'000'000);
  }
  close();
}

std::optional<GpiodTrigger::Fault> GpiodTrigger::open() {
  const auto reason = [] { return std::string(std::strerror(errno)); };
  chip_ = gpiod_chip_open_lookup(options_.chip.c_str());
  if (chip_ == nullptr) return Fault{"chip", "a GPIO chip", options_.chip + " (" + reason() + ")"};
  line_ = find_line(chip_, options_.line);
  if (line_ == nullptr) {
    const std::string expected = std::to_string(gpiod_chip_num_lines(chip_)) + " lines";
    Fault fault{"line", "a line of the chip, by number or name", options_.line + " on a chip of " + expected};
    close();
    return fault;
  }
  const int flags = options_.pulse.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (gpiod_line_request_output_flags(line_, kConsumer, flags, 0) != 0) {
    const char* user = gpiod_line_consumer(line_);
    Fault fault{
        "line", "a line that is free",
        options_.line + " (" + reason() + (user != nullptr ? ", used by " + std::string(user) : "") + ")"};
    close();
    return fault;
  }
  connected_.store(true, std::memory_order_release);
  return std::nullopt;
}

void GpiodTrigger::close() noexcept {
  if (chip_ != nullptr) gpiod_chip_close(chip_);  // releases its lines
  chip_ = nullptr;
  line_ = nullptr;
}

bool GpiodTrigger::set(bool active) noexcept {
  if (!connected()) return false;
  if (gpiod_line_set_value(line_, active ? 1 : 0) == 0) return true;
  connected_.store(false, std::memory_order_release);
  times_lost_.fetch_add(1, std::memory_order_relaxed);
  return false;
}

std::optional<TimeNs> GpiodTrigger::pulse(std::uint64_t /*number*/, TimeNs /*due_ns*/) noexcept {
  if (end_.busy()) {
    overlapped_.fetch_add(1, std::memory_order_relaxed);
    return std::nullopt;
  }
  if (!set(true)) {
    not_sent_.fetch_add(1, std::memory_order_relaxed);
    return std::nullopt;
  }
  const TimeNs edge = MonotonicClock().now();
  end_.at(edge + options_.pulse.width_ns);
  return edge;
}

// Neither pulses nor their ends touch the line once it is lost, and an end under way when it was lost has
// long seen so by the next time.
void GpiodTrigger::attend() noexcept {
  if (connected() || end_.busy()) return;
  close();
  try {
    open();
  } catch (const std::exception&) {  // no memory for the sentence; next time
  }
}

std::vector<std::string> GpiodTrigger::complaints() const {
  std::vector<std::string> sentences;
  const auto say = [&](std::uint64_t count, const char* what) {
    if (count > 0)
      sentences.push_back("trigger on " + options_.chip + " line " + options_.line + ": " + what + ", " +
                          std::to_string(count) + " times");
  };
  say(times_lost_, "the line was lost");
  say(not_sent_, "a pulse could not be sent");
  say(overlapped_, "the pulse before had not ended");
  for (const std::string& refusal : end_.refusals()) sentences.push_back(refusal);
  return sentences;
}

}  // namespace omma
