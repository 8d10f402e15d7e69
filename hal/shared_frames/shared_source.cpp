#include "hal/shared_frames/shared_source.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <ctime>
#include <utility>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

// GREY for 8 bits, else Y16, filled as far as the bits say: what is written is grey already.
CameraSetup grey(CameraSetup setup) {
  setup.format = setup.bits > 8 ? "Y16" : "GREY";
  return setup;
}

std::string shape_text(std::uint32_t width, std::uint32_t height, std::uint32_t white_level) {
  return std::to_string(width) + " x " + std::to_string(height) + " px up to " + std::to_string(white_level);
}

}  // namespace

SharedSource::SharedSource(CameraSetup setup) : setup_(grey(std::move(setup))), shape_(shape_of(setup_)) {
  for (const CameraControl& control : setup_.controls) {
    std::int32_t value = 0;
    const char* const end = control.value.data() + control.value.size();
    const auto [stop, error] = std::from_chars(control.value.data(), end, value);
    if (error != std::errc{} || stop != end || value < 0)
      throw InputError(setup_.where, 0, "controls." + control.name, "a whole number from 0", control.value);
    if (control.name != "exposure" && control.name != "gain")
      throw InputError(setup_.where, 0, "controls", "exposure [us] or gain [percent]", control.name);
    (control.name == "gain" ? gain_percent_ : exposure_us_) = value;
  }
}

void SharedSource::start() {
  const int error = memory_.open(setup_.device);
  if (error != 0) {
    stop();
    throw InputError(setup_.where, 0, "device",
                     "frames that a program writes into " + SharedFramesMemory::path_of(setup_.device),
                     std::strerror(error));
  }
  SharedFramesHeader& header = memory_.header();
  const std::string given = shape_text(header.width, header.height, header.white_level);
  const std::string wanted = shape_text(static_cast<std::uint32_t>(shape_.width),
                                        static_cast<std::uint32_t>(shape_.height), shape_.white_level);
  if (given != wanted) {
    stop();
    throw InputError(setup_.where, 0, "size", wanted, given + " from " + setup_.device);
  }
  header.exposure_us.store(exposure_us_);
  header.gain_percent.store(gain_percent_);
  next_ = header.written.load(std::memory_order_acquire);
}

// What any sensor that is simulated can do; its own saturation says what is sensible.
CameraSettingsRange SharedSource::settings_range() const {
  return {{.exposure_ns = 1'000, .gain = 0.1F}, {.exposure_ns = 10'000'000'000, .gain = 100}};
}

CameraSettings SharedSource::settings() const noexcept {
  return {.exposure_ns = TimeNs{exposure_us_} * 1000,
          .gain = gain_percent_ > 0 ? static_cast<float>(gain_percent_) / 100 : 1};
}

bool SharedSource::apply(const CameraSettings& settings) noexcept {
  exposure_us_ = static_cast<std::int32_t>(settings.exposure_ns / 1000);
  gain_percent_ = static_cast<std::int32_t>(std::lround(settings.gain * 100));
  memory_.header().exposure_us.store(exposure_us_);
  memory_.header().gain_percent.store(gain_percent_);
  return true;
}

Taken SharedSource::take(std::byte* pixels, int timeout_ms) noexcept {
  SharedFramesHeader& header = memory_.header();
  std::uint32_t written = header.written.load(std::memory_order_acquire);
  if (written == next_) {
    const timespec most{timeout_ms / 1000, (timeout_ms % 1000) * 1'000'000L};
    ::syscall(SYS_futex, &header.written, FUTEX_WAIT, next_, &most, nullptr, 0);
    written = header.written.load(std::memory_order_acquire);
  }
  if (written == next_) return {.status = memory_.has_writer() ? TakeStatus::kSilence : TakeStatus::kGone};
  return copy(written, pixels);
}

Taken SharedSource::copy(std::uint32_t written, std::byte* pixels) noexcept {
  // The writer is at most `kSlots` frames ahead; the oldest slot may be in its hands.
  constexpr std::uint32_t kSafe = SharedFramesHeader::kSlots - 1;
  if (written - next_ > kSafe) next_ = written - kSafe;
  SharedSlot& slot = memory_.slot(next_);
  Taken taken{TakeStatus::kDamaged, slot.time_ns, slot.sequence};
  const bool before = slot.frame.load(std::memory_order_acquire) == next_ + 1;
  std::memcpy(pixels, memory_.pixels(next_), shape_.bytes());
  const bool sound = slot.damaged == 0;
  // Not to be looked at before the pixels are copied: a read that is also a write orders what came before it.
  const bool whole = before && slot.frame.fetch_add(0, std::memory_order_acq_rel) == next_ + 1;
  if (whole && sound) taken.status = TakeStatus::kFrame;
  ++next_;
  return taken;
}

}  // namespace omma
