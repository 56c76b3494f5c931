#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vesselbench::fuzz {

/// A small file or blob, the start of mutations.
struct Specimen {
    std::string name;  ///< of the file, with its suffix
    std::string bytes;
};

/// Specimens by format, a key of targets(). Files of `companions` lie beside every specimen of
/// their format: the slices of a series, the voxels of a detached header.
struct Corpus {
    std::map<std::string, std::vector<Specimen>> specimens;
    std::map<std::string, std::vector<Specimen>> companions;
};

/// Writes small files of every format that is read, most by the program's own writers, and the
/// smallest reproductions of mended defects: <folder>/<format>/<file>, companions in
/// <folder>/<format>/beside/.
void write_corpus(const std::filesystem::path& folder);

[[nodiscard]] Corpus read_corpus(const std::filesystem::path& folder);

}  // namespace vesselbench::fuzz
