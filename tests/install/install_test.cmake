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

# What was built with sanitizers links with them alone.
set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()

# build_example(NAME): into SCRATCH/NAME, knowing nothing but the installed package.
function(build_example name)
  run(${CMAKE_COMMAND} -S ${EXAMPLES}/${name} -B ${SCRATCH}/${name} -G ${GENERATOR}
      -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${flags})
  run(${CMAKE_COMMAND} --build ${SCRATCH}/${name})
endfunction()
build_example(look_up)

# The centre of texel (2, 1) behind its last vertex: 60/250 in each of two layers that add up.
run(${SCRATCH}/look_up/look_up ${GOLDEN}/version1-raw.pdsm 1.25 -2 3.75)
string(STRIP "${output}" attenuation)
if(NOT attenuation STREQUAL "0.48")
  message(FATAL_ERROR "look_up printed ${attenuation}, not 0.48")
endif()

if(WITH_BAKE)
  build_example(bake_in_memory)
  # A floor of 12 x 12 m under a roof of 2 x 2: dark below the roof, lit beside it.
  run(${SCRATCH}/bake_in_memory/bake_in_memory ${SCRATCH}/memory.pdsm)
  string(REGEX MATCH "below 1, beside 0" found "${output}")
  if(NOT found)
    message(FATAL_ERROR "bake_in_memory printed ${output}")
  endif()
  run(${BUILD}/bin/pdsm check ${SCRATCH}/memory.pdsm)
  # Cancelled, it writes nothing and says so.
  file(REMOVE ${SCRATCH}/memory.pdsm)
  execute_process(COMMAND ${SCRATCH}/bake_in_memory/bake_in_memory ${SCRATCH}/memory.pdsm 0
                  RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE error)
  if(NOT result EQUAL 130 OR EXISTS ${SCRATCH}/memory.pdsm OR NOT error MATCHES "bake: interrupted")
    message(FATAL_ERROR "a cancelled bake_in_memory: ${result}, ${error}")
  endif()
endif()

if(WITH_GL)
  build_example(gl_shadow)
  # expect_pixel(COLUMN ROW VALUE): of the picture, rows from the bottom, red.
  function(expect_pixel column row value)
    math(EXPR offset "15 + 3 * (512 * ${row} + ${column})")
    file(READ ${SCRATCH}/picture.ppm found OFFSET ${offset} LIMIT 1 HEX)
    if(NOT found STREQUAL value)
      message(FATAL_ERROR "gl_shadow: pixel ${column}, ${row} is ${found}, not ${value}")
    endif()
  endfunction()
  # A plate between light and floor: its umbra at the far end, and light beside it.
  run(${BUILD}/bin/pdsm bake ${EXAMPLES}/scenes/plate.scene.json --resolution 128 --samples 64 --quiet
      -o ${SCRATCH}/plate.pdsm)
  run(${XVFB_RUN} -a ${SCRATCH}/gl_shadow/gl_shadow ${SCRATCH}/plate.pdsm ${SCRATCH}/picture.ppm)
  expect_pixel(296 230 00)
  expect_pixel(20 20 ff)
endif()
file(REMOVE_RECURSE ${SCRATCH})
