# SPDX-License-Identifier: Apache-2.0
# Run by CMakeLists.txt here.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${result}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)

# The centre of texel (2, 1) behind its last vertex: 60/250 in each of two layers that add up.
run(${SCRATCH}/build/look_up ${GOLDEN}/version1-raw.pdsm 1.25 -2 3.75)
string(STRIP "${output}" attenuation)
if(NOT attenuation STREQUAL "0.48")
  message(FATAL_ERROR "look_up printed ${attenuation}, not 0.48")
endif()
file(REMOVE_RECURSE ${SCRATCH})
