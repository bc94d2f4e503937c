# What `cmake --install` puts beside the program for shells and man, and the Debian package that cpack makes of all of it.
include(GNUInstallDirs)
if(NOT CMAKE_CROSSCOMPILING)
  set(duet_shell_files)
  foreach(kind bash zsh fish man)
    set(file ${CMAKE_BINARY_DIR}/share/duet.${kind})
    add_custom_command(OUTPUT ${file} DEPENDS duet VERBATIM
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/share
      COMMAND duet completion ${kind} > ${file})
    list(APPEND duet_shell_files ${file})
  endforeach()
  add_custom_target(duet_shell_files ALL DEPENDS ${duet_shell_files})
  set(share ${CMAKE_INSTALL_DATADIR})
  install(FILES ${CMAKE_BINARY_DIR}/share/duet.bash RENAME duet DESTINATION ${share}/bash-completion/completions)
  install(FILES ${CMAKE_BINARY_DIR}/share/duet.zsh RENAME _duet DESTINATION ${share}/zsh/vendor-completions)
  install(FILES ${CMAKE_BINARY_DIR}/share/duet.fish DESTINATION ${share}/fish/vendor_completions.d)
  install(FILES ${CMAKE_BINARY_DIR}/share/duet.man RENAME duet.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/duet)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Duet developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Bidirectional renderer for Mitsuba and pbrt scene files")
set(CPACK_PACKAGE_DESCRIPTION "Path tracing, light tracing, bidirectional path tracing, photon mapping and\n\
 vertex connection and merging for scene files of Mitsuba 0.4 to 3 and of pbrt 3 and 4.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# The libraries that it is linked with become dependencies.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
