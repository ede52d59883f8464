# SPDX-License-Identifier: MIT
# Builds the program 'hedron_model', which makes meshes of any size for scenes and measurements.
add_executable(hedron_model
    scenes/models/knot.c
    scenes/models/main.c
    scenes/models/obj_writer.c
    scenes/models/soup.c
    scenes/models/sphere.c)
target_link_libraries(hedron_model PRIVATE hedron_core)
hedron_compile_options(hedron_model)
install(TARGETS hedron_model RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
