# SPDX-License-Identifier: MIT
# Toolchain file for HEDRON_PROCESSOR (aarch64, s390x, ...): the cross compiler of Debian, the processor's libraries in
# HEDRON_ROOT, which "./dev test --all" fills, and qemu for what runs while building and for tests.
set(HEDRON_ROOT ${CMAKE_CURRENT_LIST_DIR}/../build/root-${HEDRON_PROCESSOR} CACHE PATH "Root of another processor's libraries")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES HEDRON_PROCESSOR HEDRON_ROOT)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${HEDRON_PROCESSOR})
set(CMAKE_C_COMPILER ${HEDRON_PROCESSOR}-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER ${HEDRON_PROCESSOR}-linux-gnu-g++) # OpenEXR's, of packaging/wheel
set(CMAKE_C_LIBRARY_ARCHITECTURE ${HEDRON_PROCESSOR}-linux-gnu)
set(CMAKE_LIBRARY_ARCHITECTURE ${HEDRON_PROCESSOR}-linux-gnu)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${HEDRON_PROCESSOR}-static;-L;${HEDRON_ROOT})
set(CMAKE_SYSROOT ${HEDRON_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_LIBDIR} ${HEDRON_ROOT}/usr/lib/${HEDRON_PROCESSOR}-linux-gnu/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${HEDRON_ROOT})
