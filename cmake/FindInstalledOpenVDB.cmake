# SPDX-License-Identifier: Apache-2.0
# OpenVDB comes with a find module instead of a package configuration. Its folder has modules for other
# libraries as well, which nothing else shall find.
set(pdsm_module_path ${CMAKE_MODULE_PATH})
list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
find_package(OpenVDB 10 REQUIRED COMPONENTS openvdb)
set(CMAKE_MODULE_PATH ${pdsm_module_path})
