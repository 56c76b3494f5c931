#include "workbench/project/source_files.h"

#include <algorithm>
#include <system_error>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/project/content_hash.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// Calls `visit(parameter name, path)` for every file argument.
template <class Visit>
void for_each_file(const Operation& operation, const Arguments& arguments, Visit visit) {
    for (const Parameter& parameter : operation.parameters)
        if (parameter.type == ParameterType::File && arguments.has(parameter.name))
            visit(parameter.name, arguments.text(parameter.name));
}

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::exists(path, error);
}

/// True if the place, relative to a folder, does not lead out of it.
bool is_inside(const fs::path& place) {
    return place.is_relative() && std::ranges::count(place, fs::path("..")) == 0;
}

bool is_bare(const std::string& name) {
    return !name.empty() && fs::path(name).filename() == name && name != "." && name != "..";
}

/// The place of a file inside the project's folder. Empty for any other: it would keep the names of
/// a user's folders, and in a project from a stranger it could name any file.
std::string place_of(const fs::path& path, const fs::path& folder) {
    if (folder.empty() || fs::is_directory(path)) return {};
    const fs::path place = fs::absolute(path).lexically_relative(folder);
    return !place.empty() && is_inside(place) ? place.string() : std::string();
}

/// How a project names a file: without its folder. A folder of DICOM slices is often called after
/// the patient, so that its own name is not kept.
std::string stored_name(const std::string& path) {
    std::error_code error;
    return fs::is_directory(path, error) ? "dicom-slices" : bare_name(path);
}

std::vector<fs::path> candidates_for(const SourceFile& source, const FilePlaces& places) {
    std::vector<fs::path> candidates;
    if (!source.place.empty() && is_inside(source.place))
        candidates.push_back(places.folder / source.place);
    if (!places.folder.empty()) {
        candidates.push_back(places.folder / source.name);
        candidates.push_back(places.folder.parent_path() / source.name);
    }
    candidates.emplace_back(source.name);
    const auto read = places.read.find(source.hash);
    if (read != places.read.end()) candidates.push_back(read->second);
    return candidates;
}

std::string found_again(const SourceFile& source, const FilePlaces& places) {
    bool other_content = false;
    for (const fs::path& candidate : candidates_for(source, places)) {
        if (!is_there(candidate)) continue;
        if (hash_of_file(candidate) == source.hash) return candidate.string();
        other_content = true;
    }
    throw IoError(source.name + (other_content ? " has changed since it was read" : " is missing") +
                  (is_inside(source.place)
                       ? ""
                       : " (its stored place is outside the project's folder and is not used)") +
                  "; put the file with SHA-256 " + source.hash.substr(0, 12) +
                  "... beside the project, or give " + source.parameter + "=PATH");
}

}  // namespace

void remember(ReadFiles& read, const std::vector<SourceFile>& sources, const Arguments& located) {
    for (const SourceFile& source : sources)
        read[source.hash] = fs::absolute(located.text(source.parameter));
}

Arguments without_folders(const Operation& operation, const Arguments& arguments) {
    Arguments bare = arguments;
    for_each_file(operation, arguments, [&](const std::string& name, const std::string& path) {
        bare.set(name, stored_name(path));
    });
    return bare;
}

std::vector<SourceFile> source_files(const Operation& operation, const Arguments& arguments,
                                     const fs::path& folder) {
    std::vector<SourceFile> sources;
    for_each_file(operation, arguments, [&](const std::string& name, const std::string& path) {
        if (!is_there(path)) return;
        sources.push_back({name, stored_name(path), hash_of_file(path), place_of(path, folder)});
    });
    return sources;
}

Arguments with_found_files(const Operation& operation, const Arguments& arguments,
                           const std::vector<SourceFile>& sources, const FilePlaces& places) {
    Arguments found = arguments;
    for_each_file(operation, arguments, [&](const std::string& name, const std::string& path) {
        const auto source = std::find_if(sources.begin(), sources.end(), [&](const auto& s) {
            return s.parameter == name && s.name == path;
        });
        if (source != sources.end()) found.set(name, found_again(*source, places));
    });
    return found;
}

void require_bare_files(const Operation& operation, const Arguments& stored) {
    for_each_file(operation, stored, [&](const std::string& name, const std::string& path) {
        if (!is_bare(path))
            throw InvalidInput("the project refers to a file outside its folder, " + name + " = '" +
                               shortened(printable(path)) +
                               "', which no vesselbench stores: give " + name + "=PATH");
    });
}

bool reads_files(const Operation& operation, const Arguments& arguments) {
    bool reads = false;
    for_each_file(operation, arguments, [&](const auto&, const auto&) { reads = true; });
    return reads;
}

}  // namespace vesselbench
