# SPDX-License-Identifier: MIT
# A Debian package of what is installed: ./dev package.
set(CPACK_GENERATOR DEB)
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
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, pocl-opencl-icd | opencl-icd")
include(CPack)
