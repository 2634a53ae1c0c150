# SPDX-License-Identifier: Apache-2.0
# man pages from the program's own help: pdsm(1), and pdsm-COMMAND(1) for each command.
find_program(HELP2MAN help2man REQUIRED)
set(PDSM_COMMANDS bake merge info check query truth verify tradeoff render export import diff)

# pdsm_add_man_page(NAME SUMMARY COMMAND): NAME.1 out of `COMMAND --help`.
function(pdsm_add_man_page name summary command)
  set(page ${CMAKE_BINARY_DIR}/man/${name}.1)
  add_custom_command(OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/man
    COMMAND ${HELP2MAN} --no-info --no-discard-stderr --section=1 --version-string=${PROJECT_VERSION}
            --name=${summary} --output=${page} ${command}
    DEPENDS pdsm VERBATIM)
  set(man_pages ${man_pages} ${page} PARENT_SCOPE)
endfunction()

pdsm_add_man_page(pdsm "bakes soft shadows of area lights into maps that anything can look up anywhere" $<TARGET_FILE:pdsm>)
foreach(command IN LISTS PDSM_COMMANDS)
  pdsm_add_man_page(pdsm-${command} "command of pdsm, penumbra deep shadow maps" "$<TARGET_FILE:pdsm> ${command}")
endforeach()
add_custom_target(pdsm_man ALL DEPENDS ${man_pages})
install(FILES ${man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
