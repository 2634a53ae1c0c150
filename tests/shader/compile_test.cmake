# SPDX-License-Identifier: Apache-2.0
# Run by CMakeLists.txt here.
file(READ ${SHADER} text)
file(MAKE_DIRECTORY ${SCRATCH})

# compile(FILE CONTENTS ARGUMENTS...): the validator takes it without a word of error or warning.
function(compile name contents)
  file(WRITE ${SCRATCH}/${name} "${contents}")
  execute_process(COMMAND ${VALIDATOR} ${ARGN} ${SCRATCH}/${name}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR output MATCHES "ERROR|WARNING")
    message(FATAL_ERROR "${LANGUAGE} ${LAYOUT} ${name}:\n${output}")
  endif()
endfunction()

set(define "")
if(LAYOUT STREQUAL fixed_depth)
  set(define "#define PDSM_FIXED_DEPTH\n")
endif()

if(LANGUAGE STREQUAL hlsl)
  file(READ ${HERE}/hlsl_macros.h macros)
  file(READ ${HERE}/example.hlsl example)
  compile(example.hlsl "${define}${macros}${text}${example}" -D -V -S frag -e main -o ${SCRATCH}/example.spv)
else()
  string(REPLACE "300es" "300 es" version ${LANGUAGE})
  foreach(stage vert frag)
    file(READ ${HERE}/example.${stage} example)
    compile(example.${stage} "#version ${version}\n${define}${text}${example}")
  endforeach()
endif()
