# Designated initialisers omit members with defaults: no warning for that.
# -Wno-restrict and the next three: g++ 12 reports false overlaps and bounds in std::string (GCC bug 105651), more of
# them where the header comes precompiled.
# Our own code: warnings are errors. The same build on the same kind of CPU gives the same bits (DESIGN 1),
# so multiplications and additions are never contracted.
add_library(vesselbench_options INTERFACE)
# The sanitizers' code confuses g++'s flow analysis, so warnings count in plain builds only.
set(WARNINGS -Wall -Wextra -Wshadow -Werror -Wno-missing-field-initializers
  -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
# Where sources are compiled together, these two take what a neighbour declares for a header's; builds of single sources
# (the preset dev, scripts/check) have them.
if(CMAKE_UNITY_BUILD)
  list(APPEND WARNINGS -Wno-shadow -Wno-subobject-linkage)
endif()
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(WARNINGS -w)
endif()
target_compile_options(vesselbench_options INTERFACE ${WARNINGS} -ffp-contract=off)
# With AddressSanitizer, Eigen would not free as the libraries do that a sanitizer's build takes from the release build.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  target_compile_definitions(vesselbench_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
target_include_directories(vesselbench_options INTERFACE ${CMAKE_SOURCE_DIR})

# ccache believes in precompiled headers only when told to; without a preprocessor's run of its own a miss costs nothing.
# It would read all of the precompiled header for every source, hits as well (1.5 s of 190 MB each), did it not know
# files again by their inodes.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1 CCACHE_INODECACHE=1 ${CCACHE_PROGRAM})
endif()
find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  add_link_options(-fuse-ld=mold)
endif()
