#include "workbench/project/source_files.h"

#include <algorithm>
#include <system_error>

#include "geometry/kernel/errors.h"
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

std::vector<fs::path> candidates_for(const SourceFile& source, const FilePlaces& places) {
    std::vector<fs::path> candidates;
    if (!source.place.empty()) candidates.push_back(places.folder / source.place);
    if (!places.folder.empty()) candidates.push_back(places.folder / source.name);
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
        bare.set(name, bare_name(path));
    });
    return bare;
}

std::vector<SourceFile> source_files(const Operation& operation, const Arguments& arguments,
                                     const fs::path& folder) {
    std::vector<SourceFile> sources;
    for_each_file(operation, arguments, [&](const std::string& name, const std::string& path) {
        if (!is_there(path)) return;
        const std::string place =
            folder.empty() ? "" : fs::absolute(path).lexically_relative(folder).string();
        sources.push_back({name, bare_name(path), hash_of_file(path), place});
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

bool reads_files(const Operation& operation, const Arguments& arguments) {
    bool reads = false;
    for_each_file(operation, arguments, [&](const auto&, const auto&) { reads = true; });
    return reads;
}

}  // namespace vesselbench
