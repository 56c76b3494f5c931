#pragma once

#include <map>
#include <set>
#include <string>

namespace vesselbench::test {

/// A folder whose files may include those of certain other rooms only.
struct DeclaredRoom {
    std::set<std::string> doors;  ///< those rooms; a folder means all rooms below it
    std::string declared_in;      ///< folder of the CMakeLists.txt
};

/// A library or program.
struct DeclaredTarget {
    std::set<std::string> sources;  ///< without generated ones; none: a bundle of other targets
    std::set<std::string> links;    ///< our own targets among what it links
};

/// What the CMakeLists.txt declare by the functions of cmake/Rooms.cmake. All paths are relative to
/// the repository.
struct RoomTable {
    std::map<std::string, DeclaredRoom> rooms;
    std::map<std::string, DeclaredTarget> targets;
};

/// Whether the path is the folder or below it.
[[nodiscard]] bool is_below(const std::string& path, const std::string& folder);

/// Adds what one CMakeLists.txt declares.
/// \param folder its folder
/// \param text its content
/// \param files all files of the repository that sources are taken from
/// \throw std::invalid_argument if a room is declared twice, or something in a form that is not
/// known here: nothing is passed over in silence
void read_cmake_lists(const std::string& folder, const std::string& text,
                      const std::set<std::string>& files, RoomTable& table);

}  // namespace vesselbench::test
