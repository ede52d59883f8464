# SPDX-License-Identifier: MIT
# The builds of the plain C kernels, as listed in cpu/kernel.h: instruction set, lanes, precision,
# arithmetic. Bundles that do not fill a register are there to compare bytes, not for speed: strict kernels
# stand in for their fast ones, those wider than a register are built at -O1, which keeps gcc's compile
# time bounded, and no sanitizer looks at them. With sanitizers, which look at memory and not at rounding,
# strict kernels stand in everywhere, and there are fewer of them.
string(TOLOWER "${CMAKE_SYSTEM_PROCESSOR}" processor)
set(builds generic:1 generic:4 generic:8 generic:16)
if(processor MATCHES "^(x86_64|amd64)$")
    list(APPEND builds avx2:1 avx2:4 avx2:8 avx512:8 avx512:16)
    target_compile_definitions(hedron_core PRIVATE HD_CPU_X86)
    if(HEDRON_SANITIZE)
        list(REMOVE_ITEM builds generic:4 generic:8 generic:16)
        target_compile_definitions(hedron_core PRIVATE HD_CPU_FEW)
    endif()
endif()

# gcc takes vectors that are filled lane by lane for uninitialised.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    set(no_false_alarms -Wno-maybe-uninitialized)
endif()
set(HEDRON_KERNEL_WARNINGS ${HEDRON_WARNINGS} -Wno-unused-parameter -Wno-psabi ${no_false_alarms})

set(flags_generic "")
set(flags_avx2 -mavx2 -mfma)
set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mavx2 -mfma
    -mprefer-vector-width=512)
set(flags_strict -ffp-contract=off)
set(flags_fast -ffp-contract=fast -freciprocal-math -fno-signed-zeros)
set(wider_than_a_register generic:8:float generic:16:float generic:8:double generic:16:double
    avx2:8:double avx512:16:double)

set(to_compare ${wider_than_a_register} generic:4:double avx2:4:float avx512:8:float)

foreach(build IN LISTS builds)
    string(REPLACE ":" ";" parts ${build})
    list(GET parts 0 set)
    list(GET parts 1 lanes)
    foreach(precision float double)
        set(level -O3)
        set(arithmetics strict fast)
        set(sanitizers "")
        if("${build}:${precision}" IN_LIST wider_than_a_register OR HEDRON_SANITIZE OR
           CMAKE_BUILD_TYPE STREQUAL "Debug")
            set(level -O1)
        endif()
        if("${build}:${precision}" IN_LIST to_compare)
            set(arithmetics strict)
            set(sanitizers -fno-sanitize=all)
        elseif(HEDRON_SANITIZE)
            set(arithmetics strict)
        endif()
        foreach(math IN LISTS arithmetics)
            set(name ${set}_${lanes}_${precision}_${math})
            add_library(hedron_kernel_${name} OBJECT cpu/kernel.c)
            target_compile_definitions(hedron_kernel_${name} PRIVATE
                HD_KERNEL_NAME=hd_kernel_${name} HD_LANES=${lanes}
                HD_DOUBLE=$<STREQUAL:${precision},double>)
            if("${arithmetics}" STREQUAL strict)
                target_compile_definitions(hedron_kernel_${name} PRIVATE
                    HD_KERNEL_STANDS_FOR=hd_kernel_${set}_${lanes}_${precision}_fast)
            endif()
            target_compile_options(hedron_kernel_${name} PRIVATE ${HEDRON_KERNEL_WARNINGS}
                ${level} ${flags_${set}} -fno-math-errno -fno-trapping-math ${flags_${math}}
                ${sanitizers})
            target_sources(hedron_core PRIVATE $<TARGET_OBJECTS:hedron_kernel_${name}>)
        endforeach()
    endforeach()
endforeach()
