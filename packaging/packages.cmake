# SPDX-License-Identifier: Apache-2.0
# What is installed beside the programs, and the packages: `sonarx` (the command line, its pages, the manual) and
# `sonar-explorer` (the desktop). What needs more than Python to be made is made with SONAR_PACKAGES alone.
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(made ${PROJECT_BINARY_DIR}/packaging)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# --- man pages and completion
if(SONAR_PACKAGES)
  string(TIMESTAMP SONAR_DATE "%Y-%m-%d" UTC)  # SOURCE_DATE_EPOCH, where it is set
  set(programs --sonarx $<TARGET_FILE:sonarx>)
  set(built sonarx)
  if(TARGET sonar-explorer)
    list(APPEND programs --explorer $<TARGET_FILE:sonar-explorer>)
    list(APPEND built sonar-explorer)
  endif()
  add_custom_command(OUTPUT ${made}/words.stamp
                     COMMAND ${CMAKE_COMMAND} -E rm -rf ${made}/words
                     COMMAND Python3::Interpreter -B ${packaging}/make_man ${programs} --out ${made}/words --date ${SONAR_DATE}
                             --manual ${CMAKE_INSTALL_FULL_DOCDIR}/user-guide.md
                     COMMAND gzip -9n -r ${made}/words/man
                     COMMAND ${CMAKE_COMMAND} -E touch ${made}/words.stamp
                     DEPENDS ${built} ${packaging}/make_man COMMENT "man pages and completion" VERBATIM)
  set(commands --commands ${made}/words/commands.md)
  set(words ${made}/words.stamp)
endif()

# --- pages: every --help names the user guide, so a program that is installed by hand has them too
file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/*.md ${PROJECT_SOURCE_DIR}/docs/*.md
     ${PROJECT_SOURCE_DIR}/docs/pictures/*)
add_custom_command(OUTPUT ${made}/pages.stamp
                   COMMAND Python3::Interpreter -B ${packaging}/make_pages --out ${made}/pages ${commands}
                   COMMAND ${CMAKE_COMMAND} -E touch ${made}/pages.stamp
                   DEPENDS ${words} ${packaging}/make_pages ${pages} COMMENT "pages" VERBATIM)
add_custom_target(package_words ALL DEPENDS ${words} ${made}/pages.stamp)
install(DIRECTORY ${made}/pages/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT cli)
if(NOT SONAR_PACKAGES)
  return()
endif()

install(DIRECTORY ${made}/words/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT cli
        PATTERN sonar-explorer.1.gz EXCLUDE)
install(FILES ${made}/words/bash/sonarx DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT cli)
# Debian's zsh looks for packages' completion in vendor-completions alone, and under /usr/local in site-functions.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(zsh_folder vendor-completions)
else()
  set(zsh_folder site-functions)
endif()
install(FILES ${made}/words/zsh/_sonarx DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder} COMPONENT cli)
install(FILES ${made}/words/fish/sonarx.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT cli)
install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT cli)

# --- the manual
find_program(SONAR_MKDOCS mkdocs)
if(SONAR_MKDOCS)
  set(SONAR_PAGES ${made}/pages)
  set(SONAR_MANUAL_HTML ${made}/html)
  configure_file(${packaging}/mkdocs.yml.in ${made}/mkdocs.yml @ONLY)
  add_custom_command(OUTPUT ${made}/html.stamp
                     COMMAND ${SONAR_MKDOCS} build --quiet --clean --config-file ${made}/mkdocs.yml
                     # For a server, and fonts in the forms of old browsers: three times the size of all the pages.
                     COMMAND ${CMAKE_COMMAND} -E rm -rf ${made}/html/sitemap.xml ${made}/html/sitemap.xml.gz ${made}/html/404.html
                             ${made}/html/css/fonts
                     COMMAND find ${made}/html/fonts -type f ! -name *.woff2 -delete
                     # In an older build folder it would be another time than the package's.
                     COMMAND sed -i "/^Build Date UTC/d" ${made}/html/index.html
                     COMMAND ${CMAKE_COMMAND} -E touch ${made}/html.stamp
                     DEPENDS ${made}/pages.stamp ${made}/mkdocs.yml COMMENT "manual" VERBATIM)
  add_custom_target(manual ALL DEPENDS ${made}/html.stamp)
  # The pages beside it have the same pictures.
  file(MAKE_DIRECTORY ${made}/link)
  file(CREATE_LINK ../pictures ${made}/link/pictures SYMBOLIC)
  install(DIRECTORY ${made}/html DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT cli REGEX "html/pictures" EXCLUDE)
  install(FILES ${made}/link/pictures DESTINATION ${CMAKE_INSTALL_DOCDIR}/html COMPONENT cli)
else()
  message(STATUS "mkdocs is not here: the manual is left out of the packages (tools/setup.sh packages)")
endif()

# --- the desktop's place among other programs
if(TARGET sonar-explorer)
  set(data ${CMAKE_INSTALL_DATADIR})
  configure_file(${packaging}/desktop/sonar-explorer.metainfo.xml.in ${made}/sonar-explorer.metainfo.xml @ONLY)
  install(FILES ${made}/words/man/sonar-explorer.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT desktop)
  install(FILES ${packaging}/desktop/sonar-explorer.desktop DESTINATION ${data}/applications COMPONENT desktop)
  install(FILES ${packaging}/desktop/sonar-explorer.xml DESTINATION ${data}/mime/packages COMPONENT desktop)
  install(FILES ${made}/sonar-explorer.metainfo.xml DESTINATION ${data}/metainfo COMPONENT desktop)
  install(FILES ${packaging}/desktop/sonar-explorer.svg DESTINATION ${data}/icons/hicolor/scalable/apps COMPONENT desktop)
  foreach(size 48 128)
    install(FILES ${packaging}/desktop/sonar-explorer-${size}.png RENAME sonar-explorer.png
            DESTINATION ${data}/icons/hicolor/${size}x${size}/apps COMPONENT desktop)
  endforeach()
  install(FILES ${packaging}/copyright DESTINATION ${data}/doc/sonar-explorer COMPONENT desktop)
endif()

# --- the packages
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_VENDOR "Sonar Explorer developers")
set(CPACK_PACKAGE_CONTACT "Sonar Explorer developers")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${packaging}/clamp_times.cmake)
set(CPACK_COMPONENTS_ALL cli)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_CLI_PACKAGE_NAME sonarx)
set(CPACK_COMPONENT_CLI_DESCRIPTION
    "find fish schools in fishery-sonar surveys (command line)
Reads raw Simrad files of a 4D fishery sonar (MS70) and produces the schools in
them: their masks through time, tables of measurements and a map for QGIS.

This package holds the command line, its pages and the manual. It needs neither
Qt nor a display.")
# Volumes are drawn with OpenGL where it is there, and else without; text is drawn with whatever fonts there are.
set(CPACK_DEBIAN_CLI_PACKAGE_RECOMMENDS "fonts-dejavu-core")
set(CPACK_DEBIAN_CLI_PACKAGE_SUGGESTS "ffmpeg, libegl1, libopengl0, libgl1-mesa-dri")
if(TARGET sonar-explorer)
  list(APPEND CPACK_COMPONENTS_ALL desktop)
  set(CPACK_DEBIAN_DESKTOP_PACKAGE_NAME sonar-explorer)
  set(CPACK_DEBIAN_DESKTOP_PACKAGE_DEPENDS "sonarx (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_DESKTOP_PACKAGE_RECOMMENDS "libgl1-mesa-dri")
  set(CPACK_DEBIAN_DESKTOP_PACKAGE_SUGGESTS "qt6-wayland")
  set(CPACK_COMPONENT_DESKTOP_DESCRIPTION
      "find fish schools in fishery-sonar surveys (desktop)
Shows surveys of a 4D fishery sonar (MS70) in slices, volumes, maps and a
timeline. A click selects a school, a double click follows it through time.")
endif()
if(TARGET sonar_explorer)
  list(APPEND CPACK_COMPONENTS_ALL runtime library)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libsonar-explorer)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
  set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
      "find fish schools in fishery-sonar surveys (shared library)
What programs and the Python module need that open surveys, detect, select and
measure schools.")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libsonar-explorer-dev)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libsonar-explorer (= ${PROJECT_VERSION})")
  set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
      "find fish schools in fishery-sonar surveys (headers)
C++ headers, and what CMake's find_package(SonarExplorer) reads.")
  install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsonar-explorer COMPONENT runtime)
  install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsonar-explorer-dev COMPONENT library)
endif()
if(TARGET sonar_explorer_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-sonar-explorer COMPONENT python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-sonar-explorer)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "libsonar-explorer (= ${PROJECT_VERSION}), ${SONAR_PYTHON_DEPENDS}, python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-xarray, python3-matplotlib")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src/api)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "find fish schools in fishery-sonar surveys (Python)
The module sonar_explorer: a survey's pings as NumPy arrays, schools detected,
selected, propagated and measured, results read.")
endif()
include(CPack)
