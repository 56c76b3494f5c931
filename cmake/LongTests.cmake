# What ctest has to know of single tests before it has a history of their times: long_tests(FILE), behind the last test of
# a folder, reads lines
#   SECONDS [turns=LABEL] [both-cores] NAME
# The longest begin first. `turns`: runs by turns (scripts/test); LABEL is the test's other label. `both-cores`: nothing
# runs beside it. Tests that are found in their programs after the build get their properties from a file that ctest reads
# behind them.
function(long_tests file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(STRINGS ${file} lines REGEX "^[0-9]")
  set(script "")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([0-9]+) (turns=([a-z_]+) )?(both-cores )?(.*)$" line "${line}")
    set(name ${CMAKE_MATCH_5})
    set(properties "COST ${CMAKE_MATCH_1}")
    if(CMAKE_MATCH_2)
      string(APPEND properties " LABELS \"${CMAKE_MATCH_3};turns\"")
    endif()
    if(CMAKE_MATCH_4)
      string(APPEND properties " PROCESSORS 2")
    endif()
    set(call "set_tests_properties([==[${name}]==] PROPERTIES ${properties})")
    if(TEST ${name})
      cmake_language(EVAL CODE "${call}")
    else()
      string(APPEND script "${call}\n")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/long_tests.cmake CONTENT "${script}" @ONLY)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/long_tests.cmake)
endfunction()
