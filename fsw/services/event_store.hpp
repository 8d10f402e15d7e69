// Event store: a ring of events in a file, so that they survive to the next start. An ordinary thread copies
// what was raised (Events::history) into the file's mapping and has the system write it down; real-time
// threads never touch it. Each record has its own checksum and running number, and nothing else in the file
// changes: power cut at any byte costs the record that was being written, and no other.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fsw/services/event.hpp"
#include "fsw/services/events.hpp"

namespace omma {

inline constexpr EventDescriptor kRunBegan{
    .id = 23,
    .severity = EventSeverity::kActivity,
    .name = "run_began",
    .text = "run {0} began; {1} events of earlier runs are kept, {2} records of the event store were damaged",
    .values = {{{"run"}, {"events"}, {"damaged"}}}};

inline constexpr std::array kStoreEvents{kRunBegan};
static_assert(are_well_formed(kStoreEvents));

/// As it lies in the file: in the byte order of the machine, which is the one that reads it.
struct StoredEvent {
  std::uint64_t number = 0;  ///< counts the events of all runs, from 1
  std::uint32_t run = 0;     ///< counts the starts of the program, from 1
  std::uint32_t checksum = 0;
  EventMoment moment;
};
static_assert(sizeof(StoredEvent) == 80 && sizeof(EventMoment) == 64, "nothing is padded");

/// What lies in a store.
struct StoredEvents {
  std::vector<StoredEvent> events;  ///< oldest first
  std::size_t damaged = 0;          ///< records that are neither empty nor whole
};

/// Of a file that no program writes at the moment, or whose newest record may be missing.
/// @throws InputError where it is no event store
StoredEvents read_event_store(const std::filesystem::path& file);

class EventStore {
 public:
  static constexpr std::size_t kRecords = 4096;  ///< 320 KiB

  /// Opens the file, or makes it, with all its room on the disk; reads what earlier runs left. A file that is
  /// no event store is moved aside (".bad") and said in `notice`.
  /// @throws InputError where the file can be neither used nor made
  EventStore(const std::filesystem::path& file, Events& events, std::size_t records = kRecords);
  ~EventStore();
  EventStore(const EventStore&) = delete;
  EventStore& operator=(const EventStore&) = delete;

  /// Of this run.
  std::uint32_t run() const { return run_; }
  /// What earlier runs left, oldest first.
  const std::vector<StoredEvent>& earlier() const { return earlier_.events; }
  /// Records that were neither empty nor whole.
  std::size_t damaged() const { return earlier_.damaged; }
  /// Empty, or a sentence to tell.
  const std::string& notice() const { return notice_; }

  /// Raises kRunBegan, so that every run leaves a record.
  void begin(const Tick& tick) noexcept;
  /// Copies what was raised since the last time and has it written to the disk. On an ordinary thread; also
  /// in a handler of a fatal signal, where it does nothing if the thread was just at it.
  void serve() noexcept;

 private:
  StoredEvent* record(std::uint64_t number) const { return records_ + number % capacity_; }

  Events& events_;
  const std::size_t capacity_;
  std::byte* mapping_ = nullptr;
  StoredEvent* records_ = nullptr;
  StoredEvents earlier_;
  std::string notice_;
  std::uint32_t run_ = 1;
  std::uint64_t next_number_ = 1;
  std::uint64_t next_in_history_ = 0;
  std::uint64_t waited_for_ = UINT64_MAX;  // in the history
  std::atomic_flag busy_;
};

/// "run 3  12.300 s  warning  rate group 0 missed 2 beats…", a line an event.
std::string stored_events_text(std::span<const StoredEvent> events,
                               std::span<const EventDescriptor> descriptors);

}  // namespace omma
