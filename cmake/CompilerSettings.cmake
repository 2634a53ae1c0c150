# SPDX-License-Identifier: Apache-2.0
# One place for what every target is compiled with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Contraction into fused multiply-adds would make bits depend on the compiler's mood.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)  # GCC 12 sees overlaps in std::string's operator+ that are not there.
endif()
if(PDSM_WERROR)
  add_compile_options(-Werror)
endif()
if(PDSM_SANITIZE)
  # Null pointers are caught as they are followed; checks of each access would be a tenth of the build.
  add_compile_options(-fsanitize=${PDSM_SANITIZE} -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PDSM_SANITIZE})
endif()
