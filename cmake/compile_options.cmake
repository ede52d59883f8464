# SPDX-License-Identifier: MIT
# Sets warnings, and the arithmetic that strict mode needs: no contraction, and no -ffast-math anywhere,
# which would flush denormals for the whole process.
option(HEDRON_WERROR "Treat warnings as errors" ON)
set(HEDRON_SANITIZE "" CACHE STRING "Sanitizers to build with, for example address,undefined")

if(HEDRON_SANITIZE)
    add_compile_options(-fsanitize=${HEDRON_SANITIZE} -fno-omit-frame-pointer
                        -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${HEDRON_SANITIZE})
endif()

# In standard C, gcc widens float to double there, though the processor need not.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^s390")
    add_compile_options(-fexcess-precision=fast)
endif()

# Otherwise stat fails on 32 bits if the number of a file is larger.
if(CMAKE_SIZEOF_VOID_P EQUAL 4)
    add_compile_definitions(_FILE_OFFSET_BITS=64)
endif()

set(HEDRON_WARNINGS -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion)
# Enumerations name integer constants, which are int in C; clang 19 warns where they meet a double.
if(CMAKE_C_COMPILER_ID MATCHES "Clang")
    list(APPEND HEDRON_WARNINGS -Wno-enum-float-conversion)
endif()
if(HEDRON_WERROR)
    list(APPEND HEDRON_WARNINGS -Werror)
endif()

function(hedron_compile_options target)
    target_compile_options(${target} PRIVATE ${HEDRON_WARNINGS} -ffp-contract=off)
endfunction()
