// `omma-bench pose`, the part on the dissertation's geometry.
#pragma once

namespace omma {

void bench_fisheye_card(int trials);

}  // namespace omma
