# SPDX-License-Identifier: MIT
# Lists the builds of the plain C kernels: instruction set, lanes, precision, kind. Renderers use the first one
# that the processor can run, unless lanes are requested. Kinds:
#   full     lanes that fill a register, and single lanes
#   compare  other lanes, to compare bytes: at -O2, with up to half of gcc's time saved
# Those of HEDRON_PLAIN_KERNELS are also built for plain scenes: without meshes, refraction and light from
# behind, which take registers from code that all scenes need.
# Processors without fused multiply-add spend their time in its emulation: one lane is the fastest there.
string(TOLOWER "${CMAKE_SYSTEM_PROCESSOR}" processor)
if(processor MATCHES "^(x86_64|amd64)$")
    set(HEDRON_KERNELS avx512:16:float:full avx512:8:double:full avx512:8:float:compare
        avx2:8:float:full avx2:4:double:full avx2:4:float:compare
        avx2:1:float:full avx2:1:double:full generic:1:float:full generic:1:double:full)
    set(HEDRON_PLAIN_KERNELS avx512:16:float avx2:8:float)
    target_compile_definitions(hedron_core PRIVATE HD_CPU_X86)
elseif(processor MATCHES "^(aarch64|arm64)$")
    set(HEDRON_KERNELS neon:4:float:full neon:2:double:full neon:4:double:compare neon:1:float:full neon:1:double:full)
    set(HEDRON_PLAIN_KERNELS neon:4:float)
else()
    set(HEDRON_KERNELS generic:4:float:full generic:4:double:full generic:1:float:full generic:1:double:full)
    set(HEDRON_PLAIN_KERNELS generic:4:float)
endif()

# Tests of another processor need no kernels for plain scenes, and at least those of single lanes.
set(HEDRON_ONLY_KERNELS "" CACHE STRING "Regular expression of the kernels that are built, without those for plain scenes; empty: all")
if(HEDRON_ONLY_KERNELS)
    list(FILTER HEDRON_KERNELS INCLUDE REGEX "${HEDRON_ONLY_KERNELS}")
    set(HEDRON_PLAIN_KERNELS "")
endif()

# Builds for this machine only need the kernels that its processor runs.
if(NOT CMAKE_CROSSCOMPILING)
    include(CheckCSourceRuns)
    check_c_source_runs("int main(void) { return !__builtin_cpu_supports(\"avx512bw\"); }" HEDRON_RUNS_AVX512)
    check_c_source_runs("int main(void) { return !__builtin_cpu_supports(\"avx2\"); }" HEDRON_RUNS_AVX2)
endif()

# Sanitizers make a kernel several times as expensive to compile: kernels that this processor never uses are left
# out, and only the default packets of floats are sanitized. Single lanes cover double's own code, and the unit
# tests of the kernels' functions its packets' memory accesses. Kernels for plain scenes have no code of their own.
if(HEDRON_SANITIZE)
    set(HEDRON_PLAIN_KERNELS "")
    list(TRANSFORM HEDRON_KERNELS REPLACE ":([248]):double:full$" ":\\1:double:compare")
    if(HEDRON_RUNS_AVX512)
        list(FILTER HEDRON_KERNELS EXCLUDE REGEX "^avx2:8:|^generic:")
    elseif(HEDRON_RUNS_AVX2)
        list(FILTER HEDRON_KERNELS EXCLUDE REGEX "^avx512:|^generic:")
    endif()
endif()

# gcc mistakes vectors that are filled lane by lane for uninitialised.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    set(no_false_alarms -Wno-maybe-uninitialized)
endif()
# Undefined behaviour traps without a message, which saves a quarter of the compile time. The stack, which
# AddressSanitizer prints with handle_sigill=1, has the line.
if(HEDRON_SANITIZE MATCHES undefined AND CMAKE_C_COMPILER_ID MATCHES "Clang")
    set(without_words -fsanitize-trap=undefined)
endif()
set(HEDRON_KERNEL_WARNINGS ${HEDRON_WARNINGS} -Wno-unused-parameter -Wno-psabi ${no_false_alarms})

set(flags_generic "")
set(flags_neon "")
set(flags_avx2 -mavx2 -mfma)
set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mavx2 -mfma
    -mprefer-vector-width=512)
# gcc keeps a pointer for each array that a loop over lights or planes reads, and splits loops; both take
# registers, so that the time of scenes with many lights varies by a fifth with unrelated changes.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    list(APPEND flags_avx512 -fno-ivopts -fno-split-loops)
endif()
set(flags_strict -ffp-contract=off)
set(level_full -O3)
set(level_compare -O2)
if(HEDRON_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    set(level_full -O1)
    set(level_compare -O1)
endif()

# Adds the object library hedron_kernel_NAME to the core; further arguments are compiler options.
function(hedron_kernel name set lanes precision)
    add_library(hedron_kernel_${name} OBJECT cpu/kernel.c)
    target_compile_definitions(hedron_kernel_${name} PRIVATE
        HD_KERNEL_NAME=hd_kernel_${name} HD_LANES=${lanes} HD_DOUBLE=$<STREQUAL:${precision},double>)
    target_compile_options(hedron_kernel_${name} PRIVATE ${HEDRON_KERNEL_WARNINGS} ${ARGN} ${flags_${set}}
        -fno-math-errno -fno-trapping-math ${flags_strict})
    target_sources(hedron_core PRIVATE $<TARGET_OBJECTS:hedron_kernel_${name}>)
    set_property(GLOBAL APPEND_STRING PROPERTY HEDRON_KERNEL_NAMES " X(hd_kernel_${name})")
endfunction()

# Rows of HD_CPU_BUILDS, for cpu/instruction_set.c.
set(rows "")
foreach(kernel IN LISTS HEDRON_KERNELS)
    string(REPLACE ":" ";" parts ${kernel})
    list(POP_FRONT parts set lanes precision kind)
    # Sanitizers check memory and not rounding, and one build of each kind of packet suffices.
    set(sanitizers ${without_words})
    if(NOT kind STREQUAL full OR (HEDRON_SANITIZE MATCHES thread AND precision STREQUAL double))
        set(sanitizers -fno-sanitize=all) # threads share the same in both precisions
    endif()
    set(name ${set}_${lanes}_${precision})
    hedron_kernel(${name} ${set} ${lanes} ${precision} ${level_${kind}} ${sanitizers})
    set(plain NULL)
    if("${set}:${lanes}:${precision}" IN_LIST HEDRON_PLAIN_KERNELS)
        set(plain hd_kernel_plain_${name})
        hedron_kernel(plain_${name} ${set} ${lanes} ${precision} ${level_${kind}} -DHD_PLAIN=1)
    endif()
    string(TOUPPER "${precision}" constant)
    string(APPEND rows " \\\n    X(${set}, ${lanes}, ${constant}, hd_kernel_${name}, ${plain})")
endforeach()
get_property(names GLOBAL PROPERTY HEDRON_KERNEL_NAMES)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/cpu_builds.h CONTENT
"/* SPDX-License-Identifier: MIT */
/* X(kernel), all of them; of cmake/cpu_kernels.cmake. */
#define HD_CPU_KERNELS(X)@names@
/* X(instruction set, lanes, precision, kernel, that of plain scenes or NULL), the best first. */
#define HD_CPU_BUILDS(X)@rows@
" @ONLY)
target_include_directories(hedron_core PRIVATE ${PROJECT_BINARY_DIR})
