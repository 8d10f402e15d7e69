#include "components/imaging/picture_requests.hpp"

#include <numbers>

namespace omma {

CommandOutcome PictureRequests::receive(const Command& command) noexcept {
  return command.opcode == kRequestRegion.id ? receive_region(command) : receive_look(command);
}

// A field of 0 stands for the mission's.
CommandOutcome PictureRequests::receive_look(const Command& command) noexcept {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr double kWidestView = 0.99 * 180;  // of a pinhole [deg]
  PictureRequest wanted;
  wanted.kind = kRequestKinds[static_cast<std::size_t>(command.arguments[0])];
  wanted.pan = kDegree * command.arguments[1];
  wanted.tilt = kDegree * command.arguments[2];
  wanted.field = kDegree * command.arguments[3];
  wanted.fused = command.opcode == kRequestFused.id;
  const bool is_view = wanted.kind == ImageKind::kView || wanted.kind == ImageKind::kViewRig;
  if (is_view && command.arguments[3] > kWidestView)
    return CommandOutcome::refused(CommandReason::kArgumentRange, 3);
  return push(wanted) ? CommandOutcome::done() : CommandOutcome::refused(CommandReason::kBusy);
}

CommandOutcome PictureRequests::receive_region(const Command& command) noexcept {
  const auto number = [&command](std::size_t k) { return static_cast<int>(command.arguments[k]); };
  const int camera = number(0);
  if (camera >= table_.cameras()) return CommandOutcome::refused(CommandReason::kArgumentRange, 0);
  const int width = table_.width(camera);
  const int height = table_.height(camera);
  PictureRequest wanted;
  wanted.kind = ImageKind::kCamera;
  wanted.region = {camera, number(1), number(2), number(3), number(3)};
  if (number(3) == 0) {
    wanted.region.width = width - number(1);
    wanted.region.height = height - number(2);
  }
  if (!wanted.region.lies_in(width, height)) {
    const std::uint8_t fault = number(1) >= width ? 1 : number(2) >= height ? 2 : 3;
    return CommandOutcome::refused(CommandReason::kArgumentRange, fault);
  }
  return push(wanted) ? CommandOutcome::done() : CommandOutcome::refused(CommandReason::kBusy);
}

}  // namespace omma
