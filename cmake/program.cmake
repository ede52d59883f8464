# SPDX-License-Identifier: MIT
# The program 'hedron'. All of it but its main function is a library, so that tests can call it.
add_library(hedron_program STATIC
    src/cli/check.c
    src/cli/classic.c
    src/cli/compare.c
    src/cli/convert.c
    src/cli/devices.c
    src/cli/command_help.c
    src/cli/render.c
    src/cli/selftest.c
    src/cli/load_scene.c
    src/cli/command_table.c
    src/cli/tune.c
    src/cli/complete.c
    src/cli/new.c
    src/input/json/json_device_text.c
    src/cli/man_page.c
    src/cli/command_line.c
    src/cli/option_values.c
    src/cli/options.c
    src/cli/rendering.c
    src/cli/console.c
    src/cli/statistics.c
    src/main/program.c
    src/view/glyphs.c
    src/view/keys.c
    src/view/pace.c
    src/view/pose.c
    src/view/scale.c
    src/view/side.c
    src/view/split.c
    src/view/start_window.c
    src/view/terminal.c
    src/view/viewer.c
    src/view/viewer_lines.c
    src/view/worker.c)
target_include_directories(hedron_program SYSTEM PUBLIC ${JANSSON_INCLUDE_DIR})
target_link_libraries(hedron_program PUBLIC hedron_scene_file ${JANSSON_LIBRARY})
target_compile_definitions(hedron_program PUBLIC HD_VERSION="${PROJECT_VERSION}")
hedron_compile_options(hedron_program)

add_executable(hedron src/main/hedron.c)
target_link_libraries(hedron PRIVATE hedron_program)
hedron_compile_options(hedron)
# The window is a program of its own: nothing else needs SDL 2.
find_path(SDL2_INCLUDE_DIR SDL.h PATH_SUFFIXES SDL2)
find_library(SDL2_LIBRARY SDL2)
if(SDL2_INCLUDE_DIR AND SDL2_LIBRARY)
    add_executable(hedron-view src/main/hedron_view.c src/view/lettering.c src/view/window.c)
    target_include_directories(hedron-view SYSTEM PRIVATE ${SDL2_INCLUDE_DIR})
    target_link_libraries(hedron-view PRIVATE hedron_program ${SDL2_LIBRARY})
    hedron_compile_options(hedron-view)
    install(TARGETS hedron-view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT view)
else()
    message(STATUS "SDL 2 (libsdl2-dev) was not found, so 'hedron view' has no window, only --terminal")
endif()
install(TARGETS hedron RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(PROGRAMS farm/slurm/hedron-report farm/slurm/hedron-submit farm/slurm/hedron-task
        DESTINATION ${CMAKE_INSTALL_BINDIR})

install(FILES completions/hedron.bash RENAME hedron
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions)
# The zsh of Debian looks elsewhere for what comes by packages.
install(CODE "
    set(data \"${CMAKE_INSTALL_DATAROOTDIR}\")
    if(NOT IS_ABSOLUTE \"\${data}\")
        set(data \"\${CMAKE_INSTALL_PREFIX}/\${data}\")
    endif()
    set(folder site-functions)
    if(CMAKE_INSTALL_PREFIX MATCHES \"/usr/?$\" AND EXISTS /etc/debian_version)
        set(folder vendor-completions)
    endif()
    file(INSTALL \"${PROJECT_SOURCE_DIR}/completions/hedron.zsh\" RENAME _hedron
         DESTINATION \"\${data}/zsh/\${folder}\")")
install(FILES completions/hedron.fish DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/fish/vendor_completions.d)

# The man page is what the program prints, written whenever it is built, so that it can be installed where
# nothing else was. With the thread sanitizer it starts
# on some systems only with help, so there are none of it.
if(HEDRON_SANITIZE MATCHES thread)
    return()
endif()

# hedron_text(TOPIC FILE): what 'hedron help TOPIC' prints, in a file that is installed.
function(hedron_text topic file)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/share/${file})
    add_custom_command(
        TARGET hedron POST_BUILD
        COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:hedron> -DTOPIC=${topic}
                -DOUTPUT=${output} -P ${PROJECT_SOURCE_DIR}/cmake/write_help.cmake
        BYPRODUCTS ${output}
        VERBATIM)
    get_filename_component(folder ${file} DIRECTORY)
    install(FILES ${output} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/${folder})
endfunction()

hedron_text(man man/man1/hedron.1)
