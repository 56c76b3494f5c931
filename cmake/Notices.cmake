# Writes the notices of what the program contains of other works, as their packages state them:
#   cmake -DOUT=FILE -DTHREE=LICENSE_OF_THREE_JS -P Notices.cmake
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../packaging/compiled_in.txt packages)
set(text "Notices of the works of which vesselbench contains parts\n")
foreach(package ${packages})
  file(READ /usr/share/doc/${package}/copyright notice)
  string(APPEND text "\n\n==== ${package}\n\n${notice}")
endforeach()
if(EXISTS ${THREE})
  file(READ ${THREE} notice)
  string(APPEND text "\n\n==== three.js\n\n${notice}")
endif()
file(WRITE ${OUT} "${text}")
