# 64-bit ARM boards with Debian arm64: cmake -DCMAKE_TOOLCHAIN_FILE=toolchains/arm64.cmake -DARM64_SYSROOT=<folder>
set(MACHINE aarch64)
set(TRIPLET aarch64-linux-gnu)
set(SYSROOT_VARIABLE ARM64_SYSROOT)
set(EMULATOR qemu-aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/debian_cross.cmake)
