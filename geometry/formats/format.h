#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

/// The content of a file.
enum class FormatKind { Surface, Image, VolumeMesh, Centerlines };

/// What every row of the tables of formats says about its format: a file's name chooses its reader
/// or writer, and help and error texts list formats, by these rows.
struct Format {
    std::string name;  ///< "STL"
    FormatKind kind = FormatKind::Surface;
    std::vector<std::string> suffixes;   ///< lower case, with the dot
    std::string content;                 ///< what a file holds, for help texts
    std::string unit = "mm";             ///< of the lengths in a written file
    std::vector<std::string> also_read;  ///< suffixes of files that are read, but never written
    /// What a folder of this format is, "of DICOM slices"; empty: it is no folder. Folders have no
    /// suffix.
    std::string folder = {};
    /// Whether a file that begins with these bytes (at most kSniffedBytes) is has this format.
    /// Needed where formats share a suffix.
    bool (*sniff)(std::string_view head) = nullptr;
    bool any_name = false;  ///< such files may have any name: `sniff` decides
};

/// A row of a table. A null function: such files are not read, or not written.
/// \tparam Read type that is read, \tparam Written type that is written, \tparam More what a writer
/// is told besides
template <class Read, class Written, class... More>
struct FormatRow : Format {
    Read (*read)(const std::string& path) = nullptr;
    /// Hears a cancel within the file.
    void (*write)(const Written& content, const std::string& path, const Progress& progress,
                  More... more) = nullptr;
};

inline constexpr std::size_t kSniffedBytes = 1024;

/// True if the file's name ends in one of the format's suffixes (in any case), or the path is a
/// folder and the format takes folders.
[[nodiscard]] bool is_named_for_reading(const Format& format, const std::string& path);

/// True if a file to be written under this name would have the format.
[[nodiscard]] bool is_named_for_writing(const Format& format, const std::string& path);

/// True if the format has no `sniff`, or the file's first bytes satisfy it.
[[nodiscard]] bool content_fits(const Format& format, const std::string& path);

/// The first row that reads files of this name, else one that recognises its files by their
/// content; null: none.
template <class Row>
const Row* row_that_reads(const std::vector<Row>& rows, const std::string& path) {
    for (const Row& row : rows)
        if (row.read && is_named_for_reading(row, path)) return &row;
    for (const Row& row : rows)
        if (row.read && row.any_name && content_fits(row, path)) return &row;
    return nullptr;
}

/// The first row that writes files of this name; null: none.
template <class Row>
const Row* row_that_writes(const std::vector<Row>& rows, const std::string& path) {
    for (const Row& row : rows)
        if (row.write && is_named_for_writing(row, path)) return &row;
    return nullptr;
}

/// Suffixes of the files that are read, in the order of the table.
template <class Row>
std::vector<std::string> read_suffixes(const std::vector<Row>& rows) {
    std::vector<std::string> suffixes;
    for (const Row& row : rows) {
        if (!row.read) continue;
        suffixes.insert(suffixes.end(), row.suffixes.begin(), row.suffixes.end());
        suffixes.insert(suffixes.end(), row.also_read.begin(), row.also_read.end());
    }
    return suffixes;
}

/// Suffixes of the files that are written, in the order of the table.
template <class Row>
std::vector<std::string> written_suffixes(const std::vector<Row>& rows) {
    std::vector<std::string> suffixes;
    for (const Row& row : rows)
        if (row.write) suffixes.insert(suffixes.end(), row.suffixes.begin(), row.suffixes.end());
    return suffixes;
}

/// Names of the formats that are read, each once, in the order of the table.
template <class Row>
std::vector<std::string> read_names(const std::vector<Row>& rows) {
    std::vector<std::string> names;
    for (const Row& row : rows)
        if (row.read && (names.empty() || names.back() != row.name)) names.push_back(row.name);
    return names;
}

/// The folders among the rows: "a folder of DICOM slices". \param noun "a folder" or "folders"
template <class Row>
std::string folder_text(const std::vector<Row>& rows, const std::string& noun = "a folder") {
    std::vector<std::string> texts;
    for (const Row& row : rows)
        if (!row.folder.empty()) texts.push_back(noun + " " + row.folder);
    return enumerated(texts);
}

/// The path's suffix in lower case, with the dot; empty if it has none.
[[nodiscard]] std::string lower_suffix(const std::string& path);

}  // namespace vesselbench
