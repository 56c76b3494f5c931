# The headers that most sources read, parsed once for all targets: a quarter of a build's time went into them. Sources
# include what they use all the same: scripts/check reads them without this. No path of the project is among the
# headers, so that checkouts share a compiler cache.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "// Carries the precompiled headers of all rooms.\n")
add_library(vesselbench_precompiled OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
target_link_libraries(vesselbench_precompiled PRIVATE vesselbench_options Eigen3::Eigen TBB::tbb)
target_precompile_headers(vesselbench_precompiled PRIVATE
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numbers> <optional> <set>
  <span> <sstream> <string> <utility> <vector> <Eigen/Geometry> <nlohmann/json.hpp> <tbb/parallel_for.h>)

# All compiled targets of a folder and of those below it: reuse_precompiled_headers(FOLDER)
function(reuse_precompiled_headers folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "LIBRARY|EXECUTABLE" AND NOT type STREQUAL "INTERFACE_LIBRARY" AND
       NOT target STREQUAL "vesselbench_precompiled")
      target_precompile_headers(${target} REUSE_FROM vesselbench_precompiled)
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    reuse_precompiled_headers(${below})
  endforeach()
endfunction()
