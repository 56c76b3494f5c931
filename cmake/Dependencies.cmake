# Third-party libraries, all of them Debian packages (scripts/setup).
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel FiltersCore IOCGNSReader IOGeometry IOLegacy IOXML)
find_package(CGAL 5.5 REQUIRED)
# CGAL's Find modules shadow those of other packages: CONFIG is needed from here on.
find_package(Eigen3 CONFIG REQUIRED)
include(CGAL_Eigen3_support)
find_package(OpenMesh CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)
# Debian packages GDCM's programs separately; its file of targets reports each that is not installed.
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
find_package(GDCM CONFIG REQUIRED)
unset(CMAKE_MESSAGE_LOG_LEVEL)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(SQLite3 REQUIRED)
find_package(zstd CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(Catch2 2 CONFIG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(UTF8PROC REQUIRED IMPORTED_TARGET libutf8proc)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
find_package(glfw3 3.3 CONFIG REQUIRED)

# stb and mustache are headers only, on the compiler's own path; the fonts of labels and window are embedded.
find_path(STB_INCLUDE_DIR stb/stb_truetype.h REQUIRED)
find_path(MUSTACHE_INCLUDE_DIR kainjow/mustache.hpp REQUIRED)
find_file(LABEL_FONT DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu REQUIRED)

set(ROBOTO_FOLDER /usr/share/fonts/truetype/roboto/unhinted/RobotoTTF)
find_file(WINDOW_FONT Roboto-Regular.ttf PATHS ${ROBOTO_FOLDER} REQUIRED)
find_file(WINDOW_MEDIUM_FONT Roboto-Medium.ttf PATHS ${ROBOTO_FOLDER} REQUIRED)
find_file(WINDOW_ICON_FONT materialdesignicons-webfont.ttf
  PATHS /usr/share/fonts/truetype/materialdesignicons-webfont REQUIRED)

# xxHash is used from its header only (content_key.cpp), and has no CMake configuration.
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
add_library(xxhash::xxhash INTERFACE IMPORTED)
set_target_properties(xxhash::xxhash PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${XXHASH_INCLUDE_DIR})

# TetGen has no CMake configuration.
find_path(TETGEN_INCLUDE_DIR tetgen.h REQUIRED)
find_library(TETGEN_LIBRARY tet REQUIRED)
add_library(tetgen::tetgen UNKNOWN IMPORTED)
set_target_properties(tetgen::tetgen PROPERTIES
  IMPORTED_LOCATION ${TETGEN_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${TETGEN_INCLUDE_DIR}
  INTERFACE_COMPILE_DEFINITIONS TETLIBRARY)

# The CGNS library is loaded at run time, where a file is written.
find_path(CGNS_INCLUDE_DIR cgnslib.h REQUIRED)

# GDCM exports plain library names without their include folder.
find_path(GDCM_INCLUDE_DIR gdcmReader.h PATH_SUFFIXES gdcm-3.0 REQUIRED)
add_library(gdcm_all INTERFACE)
target_link_libraries(gdcm_all INTERFACE gdcmMSFF gdcmDSED gdcmCommon)
target_include_directories(gdcm_all SYSTEM INTERFACE ${GDCM_INCLUDE_DIR})
