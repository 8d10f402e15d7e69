# 32-bit ARM boards (ARMv7 with VFP) with Debian armhf:
#   cmake -DCMAKE_TOOLCHAIN_FILE=toolchains/armhf.cmake -DARMHF_SYSROOT=<folder>
set(MACHINE arm)
set(TRIPLET arm-linux-gnueabihf)
set(SYSROOT_VARIABLE ARMHF_SYSROOT)
set(EMULATOR qemu-arm)
include(${CMAKE_CURRENT_LIST_DIR}/debian_cross.cmake)
