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

set(HEDRON_WARNINGS -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion)
if(HEDRON_WERROR)
    list(APPEND HEDRON_WARNINGS -Werror)
endif()

function(hedron_compile_options target)
    target_compile_options(${target} PRIVATE ${HEDRON_WARNINGS} -ffp-contract=off)
endfunction()
