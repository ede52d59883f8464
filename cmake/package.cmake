# SPDX-License-Identifier: MIT
# Installs documents, scenes and completions. Documents and scenes keep their relative places, so that
# links work.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES bench/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/bench)
install(DIRECTORY docs scenes DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN models EXCLUDE PATTERN *.py EXCLUDE)
set(HEDRON_LICENCES "" CACHE PATH "Licences of libraries that are linked statically")
if(HEDRON_LICENCES)
    install(DIRECTORY ${HEDRON_LICENCES} DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
install(PROGRAMS farm/slurm/hedron-report farm/slurm/hedron-submit farm/slurm/hedron-task
        DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES completions/hedron.bash RENAME hedron
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions)
install(FILES completions/hedron.fish DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/fish/vendor_completions.d)
# Debian's zsh searches another folder for the completions of packages.
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

# Debian packages, the view separately, since it needs SDL and chafa: ./dev package.
set(CPACK_GENERATOR DEB)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # nobody who wants a package waits for tests and benches
set(CPACK_PACKAGE_NAME hedron)
set(CPACK_PACKAGE_CONTACT "The hedron project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION
    "Renders mirrors and coloured glass with lights along their edges, by plain C, OpenCL or CUDA, to the same
bytes on each, to pictures and films.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, ocl-icd-libopencl1 | libopencl1, pocl-opencl-icd | opencl-icd")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME hedron)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SUGGESTS hedron-view)
set(CPACK_COMPONENT_UNSPECIFIED_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION_SUMMARY}\n${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_DEBIAN_VIEW_PACKAGE_NAME hedron-view)
set(CPACK_DEBIAN_VIEW_PACKAGE_DEPENDS "hedron (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_VIEW_PACKAGE_RECOMMENDS "")
set(CPACK_COMPONENT_VIEW_DESCRIPTION "What hedron view shows\nA scene live, in a window or a terminal; a program of its own, for it needs SDL 2 and chafa.")
include(CPack)
