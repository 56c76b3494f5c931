# Installation, and the Debian packages that `cpack` makes of it (scripts/package): one of each component, the program's here.
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(made ${CMAKE_BINARY_DIR}/packaging)
set(docs ${CMAKE_INSTALL_DATADIR}/doc/vesselbench)

# The handbook, if mkdocs is there, and the texts that follow from the program's tables, which the program prints.
find_program(MKDOCS mkdocs)
install(CODE "
  file(MAKE_DIRECTORY \"${made}/html\")
  if(NOT \"${MKDOCS}\" MATCHES NOTFOUND)
    execute_process(COMMAND \"${MKDOCS}\" build --quiet --strict --clean --site-dir \"${made}/html\"
      WORKING_DIRECTORY \"${CMAKE_SOURCE_DIR}\" COMMAND_ERROR_IS_FATAL ANY)
  endif()
  foreach(text IN ITEMS \"completion bash\" \"completion zsh\" \"completion fish\" \"recipe schema\" manual)
    string(REPLACE \" \" \"-\" file \"\${text}\")
    separate_arguments(words UNIX_COMMAND \"\${text}\")
    execute_process(COMMAND \"${CMAKE_BINARY_DIR}/vesselbench\" \${words} OUTPUT_FILE \"${made}/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  execute_process(COMMAND \"${CMAKE_COMMAND}\" -DOUT=${made}/NOTICES
    -DTHREE=${CMAKE_SOURCE_DIR}/workbench/review/page/node_modules/three/LICENSE -DHANDBOOK=${made}/html
    -P \"${CMAKE_SOURCE_DIR}/cmake/Notices.cmake\" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND \"${CMAKE_SOURCE_DIR}/scripts/sbom\" \"${CMAKE_BINARY_DIR}/vesselbench\"
    OUTPUT_FILE \"${made}/vesselbench.spdx.json\" COMMAND_ERROR_IS_FATAL ANY)
  file(COPY_FILE \"${CMAKE_SOURCE_DIR}/LICENSE\" \"${made}/LICENSE\")
  file(COPY_FILE \"${CMAKE_SOURCE_DIR}/CHANGELOG.md\" \"${made}/CHANGELOG.md\")
  foreach(file IN ITEMS manual changelog NOTICES LICENSE CHANGELOG.md vesselbench.spdx.json)
    execute_process(COMMAND gzip -9nfk \"${made}/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
")
execute_process(COMMAND git log -1 --format=%aD WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
  OUTPUT_VARIABLE VESSELBENCH_DATE OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT VESSELBENCH_DATE)
  string(TIMESTAMP VESSELBENCH_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
configure_file(${CMAKE_SOURCE_DIR}/packaging/changelog.in ${made}/changelog @ONLY)

install(TARGETS vesselbench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${made}/recipe-schema DESTINATION ${CMAKE_INSTALL_DATADIR}/vesselbench RENAME recipe.schema.json)
install(DIRECTORY cases/aneurysm DESTINATION ${CMAKE_INSTALL_DATADIR}/vesselbench/cases)
install(FILES ${made}/manual.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME vesselbench.1.gz)
install(FILES ${made}/completion-bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME vesselbench)
install(FILES ${made}/completion-zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _vesselbench)
install(FILES ${made}/completion-fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME vesselbench.fish)
install(FILES packaging/vesselbench.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES packaging/vesselbench.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES packaging/vesselbench.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES packaging/vesselbench.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
install(FILES packaging/vesselbench.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES packaging/copyright README.md CONTRIBUTING.md SECURITY.md ${made}/changelog.gz ${made}/CHANGELOG.md.gz ${made}/NOTICES.gz ${made}/LICENSE.gz
  ${made}/vesselbench.spdx.json.gz
  DESTINATION ${docs})
install(DIRECTORY docs ${made}/html DESTINATION ${docs})

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program python)
set(CPACK_PACKAGE_NAME vesselbench)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The vesselbench authors <vesselbench@example.org>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vesselbench)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")  # opened at run time
# Verifies reviewers' signatures; writes CGNS files.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "openssh-client, libcgns3.4")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "openfoam, python3-vesselbench")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"workbench that makes models of blood vessels fit for use
vesselbench turns patients' vessel images or raw vessel surfaces, such as
those of cerebral aneurysms, into models for flow simulation (closed, smooth,
capped surfaces and tetrahedral meshes) and for printing (watertight). It has
a window and a command line; every edit can be undone, replayed and reviewed.")
include(PythonPackaging)
include(CPack)
