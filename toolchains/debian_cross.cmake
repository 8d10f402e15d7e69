# Cross-build against the sysroot of a Debian of another architecture (scripts/cross_sysroot.sh). Included by the
# toolchain files, which say MACHINE (aarch64), TRIPLET (aarch64-linux-gnu) and SYSROOT_VARIABLE (ARM64_SYSROOT).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${MACHINE})
set(CMAKE_C_COMPILER ${TRIPLET}-gcc)
set(CMAKE_CXX_COMPILER ${TRIPLET}-g++)
set(CMAKE_LIBRARY_ARCHITECTURE ${TRIPLET})
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ${SYSROOT_VARIABLE})
set(CMAKE_SYSROOT ${${SYSROOT_VARIABLE}})
if(NOT CMAKE_SYSROOT)
  message(FATAL_ERROR "${SYSROOT_VARIABLE} is not set: expected the folder of a Debian for ${MACHINE}, "
                      "as scripts/cross_sysroot.sh makes one")
endif()
set(CMAKE_FIND_ROOT_PATH ${CMAKE_SYSROOT})
# Programs (idlc, pkg-config) are the host's, everything else the board's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_SYSROOT}/usr/lib/${TRIPLET}/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)
# Libraries of libraries (libddsc needs iceoryx): ld looks for them here.
string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,-rpath-link,${CMAKE_SYSROOT}/usr/lib/${TRIPLET}")
find_program(QEMU_${MACHINE} NAMES ${EMULATOR} ${EMULATOR}-static)
if(QEMU_${MACHINE})
  set(CMAKE_CROSSCOMPILING_EMULATOR ${QEMU_${MACHINE}} -L ${CMAKE_SYSROOT})
endif()
