# SPDX-License-Identifier: Apache-2.0
# pdsm_precompile(TARGET [HEADERS...]): with sanitizers, what most of the target's files begin with is read once:
# <algorithm> and its like, and the headers named. Other builds have none of it, and so see which file lacks
# an include of its own.
function(pdsm_precompile target)
  if(NOT PDSM_SANITIZE)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map> <memory>
    <numbers> <optional> <span> <string> <utility> <vector> ${ARGN})
endfunction()
