// Frames handed from one program to another through shared memory: a simulator writes them, a flight program
// reads them as a camera. The reader's settings go the other way, so that a simulator can obey them.
//
// The file /dev/shm/omma-<name> begins with a SharedFramesHeader; `slots` slots follow, each a SharedSlot and
// the pixels. Frame n (from 0) lies in slot n mod slots. The writer holds a lock on the file (flock) for as
// long as it lives, so that what a dead program left is told from a camera.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "fsw/kernel/tick.hpp"
#include "hal/live/pixel_layout.hpp"

namespace omma {

struct SharedFramesHeader {
  static constexpr std::uint64_t kMagic = 0x31304d52464d4f;  // "OMFRM01"
  static constexpr std::uint32_t kSlots = 8;

  std::atomic<std::uint64_t> magic{0};  // written last
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t white_level = 0;
  std::atomic<std::uint32_t> written{0};      // frames so far; a futex
  std::atomic<std::int32_t> exposure_us{0};   // asked for by the reader; 0: as the writer likes
  std::atomic<std::int32_t> gain_percent{0};  // the same
};

struct SharedSlot {
  std::atomic<std::uint32_t> frame{0};  // n + 1 of the frame in it, 0 while it is written
  std::uint32_t sequence = 0;           // the device's own count, frames that it lost included
  std::int64_t time_ns = 0;             // exposure midpoint, CLOCK_MONOTONIC
  std::uint64_t damaged = 0;            // 1: the device called it wrong, the pixels mean nothing
};

/// A mapped file of frames.
class SharedFramesMemory {
 public:
  SharedFramesMemory() = default;
  ~SharedFramesMemory() { close(); }
  SharedFramesMemory(const SharedFramesMemory&) = delete;
  SharedFramesMemory& operator=(const SharedFramesMemory&) = delete;

  static std::string path_of(const std::string& name) { return "/dev/shm/omma-" + name; }

  /// The writer's side: makes the file, locks it. @return 0 or the errno (EWOULDBLOCK: another writer lives)
  int create(const std::string& name, const GreyShape& shape) noexcept;
  /// The reader's side. @return 0 or the errno (ESTALE: its writer is gone, or has not begun)
  int open(const std::string& name) noexcept;
  void close() noexcept;
  /// False where the writer is gone.
  bool has_writer() const noexcept;

  bool is_open() const noexcept { return header_ != nullptr; }
  SharedFramesHeader& header() const noexcept { return *header_; }
  SharedSlot& slot(std::uint32_t frame) const noexcept;
  std::byte* pixels(std::uint32_t frame) const noexcept;
  std::size_t frame_bytes() const noexcept;

 private:
  int map(std::size_t size) noexcept;

  int file_ = -1;
  std::size_t size_ = 0;
  SharedFramesHeader* header_ = nullptr;
};

/// The simulator's end.
class SharedFramesWriter {
 public:
  /// @throws InputError where the memory cannot be had, or another program writes frames of that name
  SharedFramesWriter(const std::string& name, const GreyShape& shape);
  ~SharedFramesWriter();
  SharedFramesWriter(const SharedFramesWriter&) = delete;
  SharedFramesWriter& operator=(const SharedFramesWriter&) = delete;

  /// @param pixels  rows packed, as the shape says
  void write(const std::byte* pixels, TimeNs time_ns) noexcept;
  /// The same of a device that counts its frames.
  /// @param pixels  null for a frame that it called wrong
  void write(const std::byte* pixels, TimeNs time_ns, std::uint32_t sequence) noexcept;
  std::int32_t exposure_us() const noexcept { return memory_.header().exposure_us.load(); }
  std::int32_t gain_percent() const noexcept { return memory_.header().gain_percent.load(); }

 private:
  std::string name_;
  SharedFramesMemory memory_;
};

}  // namespace omma
