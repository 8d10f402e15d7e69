// The kernel's video nodes that this program streams from, whoever opened them: libcamera tells neither which
// ones a camera's are nor, without events of the devices, that they are gone.
#pragma once

#include <vector>

namespace omma {

/// File descriptors of this program's video nodes whose capture queues have buffers, in rising order.
std::vector<int> streaming_nodes();
/// True where the device of one of them was taken away.
bool any_gone(const std::vector<int>& nodes) noexcept;

}  // namespace omma
