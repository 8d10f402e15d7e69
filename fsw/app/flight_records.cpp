#include "fsw/app/flight_records.hpp"

#include <chrono>
#include <stdexcept>

#include "fsw/app/program_dictionary.hpp"
#include "fsw/kernel/clock.hpp"

namespace omma {
namespace {

constexpr std::chrono::milliseconds kPeriod{20};

}  // namespace

FlightRecords::FlightRecords(const RateGroupTable& table, bool lockstep, int workers, Events& events,
                             const FlightRecordFiles& files)
    : trace_at_end_(!files.trace.empty()),
      lockstep_(lockstep),
      recorder_(table, lockstep, workers),
      trace_(trace_at_end_ ? files.trace : kDefaultTrace,
             trace_at_end_ ? SlipDumps::kWritten : SlipDumps::kNone, recorder_, events, kEvents),
      events_(events),
      chores_(kPeriod) {
  if (trace_at_end_)  // whether it can be written shows now, not at the end
    if (const std::string failure = trace_.write(); !failure.empty()) throw std::runtime_error(failure);
  if (!files.events.empty()) store_ = std::make_unique<EventStore>(files.events, events);
  chores_.add([this] { trace_.serve(MonotonicClock().now()); });
}

// When the file is written, and told, is the machine's affair: a replay would not be the same twice.
CommandOutcome FlightRecords::receive(const Command& /*command*/, const Tick& /*tick*/) noexcept {
  if (lockstep_) return CommandOutcome::refused(CommandReason::kRefused);
  trace_.request();
  return CommandOutcome::done();
}

std::vector<EarlierEvent> FlightRecords::earlier() const {
  std::vector<EarlierEvent> told;
  if (store_ == nullptr) return told;
  for (const StoredEvent& event : store_->earlier())
    if (event.run + 1 == store_->run()) told.push_back({event.moment.record, 1});
  if (told.size() > kEarlierEvents) told.erase(told.begin(), told.end() - kEarlierEvents);
  return told;
}

std::vector<std::string> FlightRecords::notices() const {
  if (store_ == nullptr || store_->notice().empty()) return {};
  return {store_->notice()};
}

void FlightRecords::save_events(int signal) noexcept {
  events_.raise<kFatalSignal>(Tick{.number = 0, .time_ns = MonotonicClock().now()}, signal);
  if (store_ != nullptr) store_->serve();
}

void FlightRecords::start() {
  if (store_ != nullptr) {
    store_->begin({});
    chores_.add([this] { store_->serve(); });
  }
  chores_.start();
}

std::vector<std::string> FlightRecords::stop() {
  chores_.stop();
  std::vector<std::string> failures{trace_.failure()};
  if (trace_at_end_) failures.push_back(trace_.write());
  std::erase(failures, "");
  return failures;
}

}  // namespace omma
