# SPDX-License-Identifier: Apache-2.0
# OpenVDB comes with a find module instead of a package configuration. Its folder has modules for other
# libraries as well, and it sets BUILD_SHARED_LIBS: a function keeps both to itself.
function(pdsm_find_openvdb)
  list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
  find_package(OpenVDB 10 REQUIRED COMPONENTS openvdb)
endfunction()
pdsm_find_openvdb()
