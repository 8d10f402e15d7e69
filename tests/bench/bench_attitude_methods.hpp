// `omma-bench attitude`, second part: every method side by side.
#pragma once

namespace omma {

void compare_attitude_methods(int trials);

}  // namespace omma
