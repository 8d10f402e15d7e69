#include "hal/shared_frames/shared_frames.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>
#include <new>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr std::size_t kFirstSlot = 64;  // bytes of room for the header

std::size_t bytes_of(std::uint32_t width, std::uint32_t height, std::uint32_t white_level) {
  return std::size_t{width} * height * (white_level > 255 ? 2 : 1);
}

std::size_t slot_bytes(std::size_t frame_bytes) {
  return sizeof(SharedSlot) + (frame_bytes + 63) / 64 * 64;
}

std::size_t file_bytes(std::size_t frame_bytes) {
  return kFirstSlot + SharedFramesHeader::kSlots * slot_bytes(frame_bytes);
}

static_assert(sizeof(SharedFramesHeader) <= kFirstSlot && std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace

int SharedFramesMemory::map(std::size_t size) noexcept {
  void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (memory == MAP_FAILED) return errno != 0 ? errno : ENOMEM;
  size_ = size;
  header_ = static_cast<SharedFramesHeader*>(memory);
  return 0;
}

int SharedFramesMemory::create(const std::string& name, const GreyShape& shape) noexcept {
  close();
  const std::string path = path_of(name);
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) != 0) return errno;
  const std::size_t size = file_bytes(shape.bytes());
  // Emptied first: what another program left is not taken for frames.
  if (::ftruncate(file_, 0) != 0 || ::ftruncate(file_, static_cast<off_t>(size)) != 0) return errno;
  if (const int error = map(size); error != 0) return error;
  auto* const header = new (header_) SharedFramesHeader;
  header->width = static_cast<std::uint32_t>(shape.width);
  header->height = static_cast<std::uint32_t>(shape.height);
  header->white_level = shape.white_level;
  header->magic.store(SharedFramesHeader::kMagic, std::memory_order_release);
  return 0;
}

int SharedFramesMemory::open(const std::string& name) noexcept {
  close();
  file_ = ::open(path_of(name).c_str(), O_RDWR | O_CLOEXEC);
  struct stat about {};
  if (file_ < 0 || ::fstat(file_, &about) != 0) return errno;
  if (!has_writer() || about.st_size < static_cast<off_t>(kFirstSlot)) return ESTALE;
  if (const int error = map(static_cast<std::size_t>(about.st_size)); error != 0) return error;
  if (header_ == nullptr || header_->magic.load(std::memory_order_acquire) != SharedFramesHeader::kMagic ||
      file_bytes(frame_bytes()) != size_)
    return ESTALE;
  return 0;
}

void SharedFramesMemory::close() noexcept {
  if (header_ != nullptr) ::munmap(header_, size_);
  if (file_ >= 0) ::close(file_);
  header_ = nullptr;
  file_ = -1;
}

bool SharedFramesMemory::has_writer() const noexcept {
  if (::flock(file_, LOCK_SH | LOCK_NB) != 0) return true;
  ::flock(file_, LOCK_UN);
  return false;
}

std::size_t SharedFramesMemory::frame_bytes() const noexcept {
  return bytes_of(header_->width, header_->height, header_->white_level);
}

SharedSlot& SharedFramesMemory::slot(std::uint32_t frame) const noexcept {
  std::byte* const begin = reinterpret_cast<std::byte*>(header_) + kFirstSlot;
  return *reinterpret_cast<SharedSlot*>(begin +
                                        (frame % SharedFramesHeader::kSlots) * slot_bytes(frame_bytes()));
}

std::byte* SharedFramesMemory::pixels(std::uint32_t frame) const noexcept {
  return reinterpret_cast<std::byte*>(&slot(frame)) + sizeof(SharedSlot);
}

SharedFramesWriter::SharedFramesWriter(const std::string& name, const GreyShape& shape) : name_(name) {
  if (const int error = memory_.create(name, shape); error != 0) {
    memory_.close();
    throw InputError(SharedFramesMemory::path_of(name), 0, "frames", "memory that no other program writes",
                     std::strerror(error));
  }
}

SharedFramesWriter::~SharedFramesWriter() {
  ::unlink(SharedFramesMemory::path_of(name_).c_str());
}

void SharedFramesWriter::write(const std::byte* pixels, TimeNs time_ns) noexcept {
  write(pixels, time_ns, memory_.header().written.load(std::memory_order_relaxed));
}

void SharedFramesWriter::write(const std::byte* pixels, TimeNs time_ns, std::uint32_t sequence) noexcept {
  SharedFramesHeader& header = memory_.header();
  const std::uint32_t frame = header.written.load(std::memory_order_relaxed);
  SharedSlot& slot = memory_.slot(frame);
  slot.frame.exchange(
      0, std::memory_order_acq_rel);  // before any pixel changes: a reader of the old frame sees it
  if (pixels != nullptr) std::memcpy(memory_.pixels(frame), pixels, memory_.frame_bytes());
  slot.damaged = pixels == nullptr ? 1 : 0;
  slot.sequence = sequence;
  slot.time_ns = time_ns;
  slot.frame.store(frame + 1, std::memory_order_release);
  header.written.store(frame + 1, std::memory_order_release);
  ::syscall(SYS_futex, &header.written, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace omma
