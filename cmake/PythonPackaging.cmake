# What the component `python` installs, and its Debian package python3-vesselbench: the Python package for Debian's Python,
# of the program's version.
set(python_modules lib/python3/dist-packages)
set(python_docs ${CMAKE_INSTALL_DATADIR}/doc/python3-vesselbench)
configure_file(${CMAKE_SOURCE_DIR}/packaging/python/debian/METADATA.in ${made}/METADATA @ONLY)

install(DIRECTORY packaging/python/vesselbench DESTINATION ${python_modules} COMPONENT python
  FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
install(FILES ${made}/METADATA DESTINATION ${python_modules}/vesselbench-${PROJECT_VERSION}.dist-info COMPONENT python)
install(DIRECTORY packaging/python/examples DESTINATION ${python_docs} COMPONENT python
  FILES_MATCHING PATTERN "*.ipynb" PATTERN ".*" EXCLUDE)
install(CODE "execute_process(COMMAND gzip -9nfk \"${made}/changelog\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT python)
install(FILES packaging/copyright ${made}/changelog.gz DESTINATION ${python_docs} COMPONENT python)

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-vesselbench)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SOURCE vesselbench)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "vesselbench (= ${PROJECT_VERSION}), python3 (>= 3.11)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, jupyter-notebook")
# Compiles the modules, and removes what was compiled.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${CMAKE_SOURCE_DIR}/packaging/python/debian/postinst;${CMAKE_SOURCE_DIR}/packaging/python/debian/prerm")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"Python functions for vesselbench, which makes models of blood vessels
Runs the commands of vesselbench from Python: preparing vessel images and
surfaces for flow simulation and printing, editing projects, measuring. The
functions return typed results, and raise typed errors.")
