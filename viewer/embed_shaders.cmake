# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a header with one string constant for each of FILES: a/fog.frag becomes pdsm::shaders::fog_frag.
set(text "// Made by embed_shaders.cmake.\n#pragma once\n\n#include <string_view>\n\nnamespace pdsm::shaders {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${file} body)
  string(APPEND text "inline constexpr std::string_view ${name} = R\"glsl(${body})glsl\";\n")
endforeach()
file(WRITE ${OUTPUT} "${text}}  // namespace pdsm::shaders\n")
