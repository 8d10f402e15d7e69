// `omma-bench pose --minima`: our answers beside the global maximum-likelihood solution of the same data.
#pragma once

namespace omma {

void bench_pose_minima(int trials);

}  // namespace omma
