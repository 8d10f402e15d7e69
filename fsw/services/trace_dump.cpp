// When a trace is due, and how it gets whole onto the disk.
#include "fsw/services/trace_dump.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "fsw/services/trace_text.hpp"

namespace omma {
namespace {

/// @return 0, or the system's error
int write_whole(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path beside = file.string() + ".part";
  std::FILE* const out = std::fopen(beside.c_str(), "wb");
  if (out == nullptr) return errno;
  const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
  int error = written ? 0 : errno;
  if (std::fclose(out) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(beside.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) std::remove(beside.c_str());
  return error;
}

std::string sentence(const std::filesystem::path& file, int error) {
  return error == 0 ? "" : "no trace in " + file.string() + ": " + std::strerror(error) + ".";
}

}  // namespace

TraceDump::TraceDump(std::filesystem::path file, SlipDumps slips, const FlightRecorder& recorder,
                     Events& events, std::span<const EventDescriptor> descriptors)
    : file_(std::move(file)),
      slip_dumps_(slips),
      recorder_(recorder),
      events_(events),
      descriptors_(descriptors) {}

std::filesystem::path TraceDump::slip_path(const std::filesystem::path& file, std::uint64_t number) {
  std::filesystem::path name = file.stem();
  name += ".slip-" + std::to_string(number);
  name += file.extension();
  return file.parent_path() / name;
}

void TraceDump::serve(TimeNs now_ns) {
  if (requested_.exchange(false, std::memory_order_relaxed)) write_and_tell(file_, now_ns);
  if (slip_dumps_ == SlipDumps::kNone) return;
  if (recorder_.slips() != slips_seen_ && !slip_waits_) {
    slips_seen_ = recorder_.slips();
    slip_waits_ = slip_files_ == 0 || elapsed(slip_file_ns_, now_ns) >= kBetweenSlips;
    slip_due_ns_ = now_ns + kAfterSlip;
  }
  if (!slip_waits_ || elapsed(slip_due_ns_, now_ns) < 0) return;
  slip_waits_ = false;
  slips_seen_ = recorder_.slips();
  slip_file_ns_ = now_ns;
  write_and_tell(slip_path(file_, 1 + slip_files_++ % kSlipFiles), now_ns);
}

std::string TraceDump::write() const {
  return sentence(file_, write_whole(file_, trace_text(recorder_, events_, descriptors_).json));
}

void TraceDump::write_and_tell(const std::filesystem::path& file, TimeNs now_ns) {
  const TraceText trace = trace_text(recorder_, events_, descriptors_);
  const int error = write_whole(file, trace.json);
  const Tick tick{.number = 0, .time_ns = now_ns};
  if (error != 0) {
    failure_ = sentence(file, error);
    events_.raise<kTraceNotWritten>(tick, error);
    return;
  }
  written_.fetch_add(1, std::memory_order_relaxed);
  events_.raise<kTraceWritten>(tick, trace.records, static_cast<double>(trace.span_ns) * 1e-9);
}

}  // namespace omma
