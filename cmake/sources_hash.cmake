# SPDX-License-Identifier: MIT
# cmake -DFOLDER=... -DOUTPUT=... -P sources_hash.cmake writes a C file with a hash of all sources that
# may decide a pixel. A changed comment counts as well: a hash that errs, errs to the safe side.
set(patterns "")
foreach(folder src cpu kernels)
    foreach(ending c h inc cl cu)
        list(APPEND patterns ${FOLDER}/${folder}/*.${ending})
    endforeach()
endforeach()
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${patterns})
list(SORT files)
set(all "")
foreach(file IN LISTS files ITEMS CMakeLists.txt cmake/compile_options.cmake cmake/cpu_kernels.cmake)
    file(SHA256 ${FOLDER}/${file} hash)
    string(APPEND all "${file} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
file(WRITE ${OUTPUT} "extern const char hd_sources_hash[];\nconst char hd_sources_hash[] = \"${hash}\";\n")
