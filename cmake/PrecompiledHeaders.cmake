# The headers that most sources read, parsed once for all targets: a quarter of a build's time went into them. Sources
# include what they use all the same: scripts/check reads them without this. No path of the project is among the
# headers, so that checkouts share a compiler cache. JSON's header costs every source that carries it 0.5 s and Catch's
# as much: only the folders that use them do.
set(COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numbers> <optional> <set>
  <span> <sstream> <string> <utility> <vector> <Eigen/Geometry> <tbb/parallel_for.h>)

function(precompiled_headers name)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "// Carries precompiled headers.\n")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE vesselbench_options Eigen3::Eigen TBB::tbb)
  target_precompile_headers(${name} PRIVATE ${COMMON_HEADERS} ${ARGN})
endfunction()
precompiled_headers(precompiled_common)
precompiled_headers(precompiled_json <nlohmann/json.hpp>)
precompiled_headers(precompiled_tests <nlohmann/json.hpp> <catch2/catch.hpp>)

# All compiled targets of a folder and of those below it: compile_with(NAME FOLDER)
function(compile_with name folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "LIBRARY|EXECUTABLE" AND NOT type STREQUAL "INTERFACE_LIBRARY")
      target_precompile_headers(${target} REUSE_FROM ${name})
      compile_together(${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    compile_with(${name} ${below})
  endforeach()
endfunction()
