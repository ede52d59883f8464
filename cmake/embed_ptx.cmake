# SPDX-License-Identifier: MIT
# Embeds PTX of the CUDA kernels, for users without NVRTC, made by NVRTC 12: the last that compiles for a Pascal
# card. ./dev test --all fetches one. Without one, or with -DHEDRON_NVRTC12=OFF, no PTX is embedded.
set(HEDRON_NVRTC12 ${PROJECT_SOURCE_DIR}/build/nvrtc12/nvidia/cuda_nvrtc/lib/libnvrtc.so.12
    CACHE FILEPATH "NVRTC 12 for the PTX that is embedded and for the compile tests")

# Compiler of the kernels, separate from the program, since PTX becomes a part of that.
add_library(hedron_cuda_compiler STATIC ${PROJECT_BINARY_DIR}/embedded/hd_cuda_source.c)
target_compile_definitions(hedron_cuda_compiler PRIVATE HD_VERSION="${PROJECT_VERSION}")
target_link_libraries(hedron_cuda_compiler PUBLIC Threads::Threads ${CMAKE_DL_LIBS})
hedron_compile_options(hedron_cuda_compiler)
list(REMOVE_ITEM HEDRON_EMBEDDED ${PROJECT_BINARY_DIR}/embedded/hd_cuda_source.c)

add_executable(hedron_embed_ptx cmake/embed_ptx.c)
target_link_libraries(hedron_embed_ptx PRIVATE hedron_cuda_compiler)
hedron_compile_options(hedron_embed_ptx)

set(nvrtc "")
if(EXISTS "${HEDRON_NVRTC12}" AND NOT HEDRON_SANITIZE AND NOT CMAKE_CROSSCOMPILING)
    set(nvrtc ${HEDRON_NVRTC12})
endif()
set(HEDRON_PTX ${PROJECT_BINARY_DIR}/embedded/hd_cuda_ptx.c)
add_custom_command(
    OUTPUT ${HEDRON_PTX}
    COMMAND ${CMAKE_COMMAND} -E env HEDRON_CACHE=off ${CMAKE_CROSSCOMPILING_EMULATOR}
            $<TARGET_FILE:hedron_embed_ptx> ${HEDRON_PTX} ${nvrtc}
    DEPENDS hedron_embed_ptx ${nvrtc}
    VERBATIM)
