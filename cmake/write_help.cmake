# SPDX-License-Identifier: MIT
# cmake -DPROGRAM=... -DTOPIC=... -DOUTPUT=... -P write_help.cmake
get_filename_component(folder ${OUTPUT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${PROGRAM} help ${TOPIC} OUTPUT_FILE ${OUTPUT} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    file(REMOVE ${OUTPUT})
    message(FATAL_ERROR "hedron help ${TOPIC} failed: ${result}")
endif()
