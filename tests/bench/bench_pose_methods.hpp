// `omma-bench pose --methods`: every method for pose side by side.
#pragma once

namespace omma {

void compare_pose_methods(int trials);

}  // namespace omma
