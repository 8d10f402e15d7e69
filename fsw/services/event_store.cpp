// The file of the event store: a head that never changes, then the records.
#include "fsw/services/event_store.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/crc32.hpp"
#include "fsw/services/event_text.hpp"

namespace omma {
namespace {

constexpr std::size_t kHeadBytes = 4096;  // a page, so that no record shares it

struct Head {
  std::array<char, 8> name{'O', 'M', 'M', 'A', 'E', 'V', 'T', '1'};
  std::uint32_t record_bytes = sizeof(StoredEvent);
  std::uint32_t records = 0;
};

std::size_t file_bytes(std::size_t records) {
  return kHeadBytes + records * sizeof(StoredEvent);
}

std::uint32_t checksum_of(StoredEvent event) {
  event.checksum = 0;
  return crc32(std::as_bytes(std::span(&event, 1)));
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw InputError(file.string(), 0, "event store", "a file that can be read and written",
                   std::strerror(error));
}

/// Writes an empty store beside its place and renames it, so that there is never half a head.
void make(const std::filesystem::path& file, std::size_t records) {
  const std::string beside = file.string() + ".part";
  const int out = open(beside.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (out < 0) refuse(file, errno);
  const Head head{.records = static_cast<std::uint32_t>(records)};
  // All its room now: a mapping without room on the disk would end the program when it is written.
  int error = posix_fallocate(out, 0, static_cast<off_t>(file_bytes(records)));
  if (error == 0 && pwrite(out, &head, sizeof head, 0) != sizeof head) error = errno;
  if (error == 0 && fsync(out) != 0) error = errno;
  close(out);
  if (error == 0 && std::rename(beside.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  std::remove(beside.c_str());
  refuse(file, error);
}

bool is_store(int file, std::size_t records) {
  Head head;
  struct stat status {};
  const Head wanted{.records = static_cast<std::uint32_t>(records)};
  return fstat(file, &status) == 0 && static_cast<std::size_t>(status.st_size) == file_bytes(records) &&
         pread(file, &head, sizeof head, 0) == sizeof head && std::memcmp(&head, &wanted, sizeof head) == 0;
}

bool is_empty(const StoredEvent& event) {
  const auto bytes = std::as_bytes(std::span(&event, 1));
  return std::all_of(bytes.begin(), bytes.end(), [](std::byte byte) { return byte == std::byte{0}; });
}

StoredEvents whole_events(std::span<const StoredEvent> records) {
  StoredEvents whole;
  for (const StoredEvent& event : records) {
    if (is_empty(event)) continue;
    if (event.checksum == checksum_of(event))
      whole.events.push_back(event);
    else
      ++whole.damaged;
  }
  std::sort(whole.events.begin(), whole.events.end(),
            [](const StoredEvent& a, const StoredEvent& b) { return a.number < b.number; });
  return whole;
}

}  // namespace

StoredEvents read_event_store(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
    throw InputError(path.string(), 0, "event store", "a file that can be read", std::strerror(errno));
  Head head;
  const bool has_head = pread(file, &head, sizeof head, 0) == sizeof head;
  if (!has_head || !is_store(file, head.records)) {
    close(file);
    throw InputError(path.string(), 0, "event store", "what `omma-fsw --events FILE` keeps",
                     "a file with another beginning, or of another length");
  }
  std::vector<StoredEvent> records(head.records);
  const auto bytes = static_cast<ssize_t>(records.size() * sizeof(StoredEvent));
  const bool whole = pread(file, records.data(), static_cast<std::size_t>(bytes), kHeadBytes) == bytes;
  const int error = errno;
  close(file);
  if (!whole)
    throw InputError(path.string(), 0, "event store", "a file that can be read", std::strerror(error));
  return whole_events(records);
}

EventStore::EventStore(const std::filesystem::path& path, Events& events, std::size_t records)
    : events_(events), capacity_(records) {
  if (!std::filesystem::exists(path)) make(path, records);
  int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) refuse(path, errno);
  if (!is_store(file, records)) {
    close(file);
    const std::string aside = path.string() + ".bad";
    if (std::rename(path.c_str(), aside.c_str()) != 0) refuse(path, errno);
    notice_ = path.string() + " is no event store of this program: moved to " + aside + ", a new one begins.";
    make(path, records);
    file = open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) refuse(path, errno);
  }
  void* const mapping = mmap(nullptr, file_bytes(records), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  const int error = errno;
  close(file);
  if (mapping == MAP_FAILED) refuse(path, error);
  mapping_ = static_cast<std::byte*>(mapping);
  records_ = reinterpret_cast<StoredEvent*>(mapping_ + kHeadBytes);
  earlier_ = whole_events({records_, capacity_});
  if (!earlier_.events.empty()) {
    run_ = earlier_.events.back().run + 1;
    // A damaged record may have been the newest: its place is not used again before the ring comes round.
    next_number_ = earlier_.events.back().number + 1 + (earlier_.damaged > 0 ? 1 : 0);
  }
  next_in_history_ = events_.history().written();
}

EventStore::~EventStore() {
  munmap(mapping_, file_bytes(capacity_));
}

void EventStore::begin(const Tick& tick) noexcept {
  events_.raise<kRunBegan>(tick, run_, earlier_.events.size(), earlier_.damaged);
}

void EventStore::serve() noexcept {
  if (busy_.test_and_set(std::memory_order_acquire)) return;
  const Events::History& history = events_.history();
  const std::uint64_t end = history.written();
  const std::uint64_t begin = std::max(next_in_history_, history.oldest());
  bool changed = false;
  for (next_in_history_ = begin; next_in_history_ < end; ++next_in_history_) {
    StoredEvent event;
    event.number = next_number_;
    event.run = run_;
    if (!history.read(next_in_history_, event.moment)) {
      if (waited_for_ == next_in_history_) continue;  // lost
      waited_for_ = next_in_history_;                 // perhaps just being written: once more the next time
      break;
    }
    event.checksum = checksum_of(event);
    *record(next_number_) = event;
    ++next_number_;
    changed = true;
  }
  if (changed) msync(mapping_, file_bytes(capacity_), MS_SYNC);
  busy_.clear(std::memory_order_release);
}

namespace {

/// "event_17 (3, 4.5)"
std::string undeclared_text(const EventRecord& record) {
  std::string text = event_name(nullptr, record.id);
  for (std::size_t i = 0; i < std::min<std::size_t>(record.value_count, record.values.size()); ++i) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%s%.9g", i == 0 ? " (" : ", ", record.values[i]);
    text += number.data();
  }
  return record.value_count > 0 ? text + ")" : text;
}

}  // namespace

std::string stored_events_text(std::span<const StoredEvent> events,
                               std::span<const EventDescriptor> descriptors) {
  std::string text;
  for (const StoredEvent& event : events) {
    const EventRecord& record = event.moment.record;
    const EventDescriptor* const declared = find_event(descriptors, record.id);
    std::array<char, 96> head{};
    std::snprintf(head.data(), head.size(), "run %-4u %14.3f s  %-10s ", event.run,
                  static_cast<double>(record.time_ns) * 1e-9,
                  std::string(severity_name(record.severity)).c_str());
    text += head.data();
    text += declared != nullptr ? event_text(*declared, record) : undeclared_text(record);
    text += '\n';
  }
  return text;
}

}  // namespace omma
