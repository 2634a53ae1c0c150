# SPDX-License-Identifier: Apache-2.0
# `cmake --install` and find_package(pdsm COMPONENTS format runtime runtime_gl bake).
include(CMakePackageConfigHelpers)
set(PDSM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/pdsm)

set(PDSM_COMPONENTS format runtime)
if(PDSM_BUILD_GL)
  list(APPEND PDSM_COMPONENTS runtime_gl)
endif()
if(PDSM_BUILD_BAKE)
  list(APPEND PDSM_COMPONENTS bake)
endif()
foreach(component IN LISTS PDSM_COMPONENTS)
  install(TARGETS pdsm_${component} EXPORT pdsm-${component}-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT pdsm-${component}-targets NAMESPACE pdsm:: DESTINATION ${PDSM_CMAKE_DIR})
  string(REPLACE "_" "/" folder ${component})
  install(DIRECTORY ${folder}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h)
endforeach()
install(FILES runtime/shader/pdsm.glsl DESTINATION ${CMAKE_INSTALL_DATADIR}/pdsm)
if(PDSM_BUILD_BAKE)
  install(TARGETS pdsm RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES bake/cli/completion/pdsm DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()

configure_package_config_file(cmake/pdsm-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/pdsm-config.cmake
  INSTALL_DESTINATION ${PDSM_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/pdsm-config-version.cmake
  COMPATIBILITY SameMinorVersion)
if(PDSM_BUILD_BAKE)
  install(FILES cmake/FindInstalledOpenVDB.cmake DESTINATION ${PDSM_CMAKE_DIR})
endif()
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pdsm-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/pdsm-config-version.cmake
  DESTINATION ${PDSM_CMAKE_DIR})
