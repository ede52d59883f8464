# SPDX-License-Identifier: MIT
# hedron_embed(SYMBOL FILE [FLATTEN]) turns a file into a C array and adds it to HEDRON_EMBEDDED;
# FLATTEN resolves its #includes.
add_executable(hedron_embed_tool cmake/embed.c)
target_compile_options(hedron_embed_tool PRIVATE ${HEDRON_WARNINGS})

function(hedron_embed symbol file)
    cmake_parse_arguments(ARG "FLATTEN" "" "" ${ARGN})
    set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.c)
    set(flags "")
    if(ARG_FLATTEN)
        set(flags --flatten)
        get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR}/${file} DIRECTORY)
        file(GLOB includes CONFIGURE_DEPENDS ${folder}/*.h ${folder}/../common/*.h)
    endif()
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/embedded)
    add_custom_command(
        OUTPUT ${output}
        COMMAND hedron_embed_tool ${symbol} ${output} ${file} ${flags}
        DEPENDS hedron_embed_tool ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${includes}
        WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
        VERBATIM)
    set(HEDRON_EMBEDDED ${HEDRON_EMBEDDED} ${output} PARENT_SCOPE)
endfunction()
