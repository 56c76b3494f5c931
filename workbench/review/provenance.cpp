#include "workbench/review/provenance.h"

#include <filesystem>
#include <optional>

#include "geometry/kernel/wording.h"
#include "workbench/project/project.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

constexpr std::size_t kDigits = 12;

/// What `prepare` calls every project, whatever is in it.
constexpr const char* kPrepared = "project";

std::string stem_of(const std::string& file) {
    return std::filesystem::path(file).stem().string();
}

/// The first file that the case was made from.
std::optional<std::string> source_name(const Session& session) {
    for (const LogEntry& entry : session.log())
        for (const SourceFile& file : session.project().sources(entry.edit.edit))
            return stem_of(file.name);
    return std::nullopt;
}

std::string digest_of(const Session& session, const std::string& variant) {
    std::string digest;
    for (const LogEntry& entry : session.log(variant))
        if (entry.result) digest = session.project().digest(entry.result->id);
    return digest.substr(0, kDigits);
}

}  // namespace

std::string shown_name(const Session& session) {
    const ProjectFile& project = session.project();
    if (project.name().empty()) return "";
    const std::string given = stored_text(project.folder() / project.name(), StoredText::InputName);
    if (!given.empty()) return given;
    const std::string name = stem_of(project.name());
    return name == kPrepared ? source_name(session).value_or(name) : name;
}

std::string provenance(const Session& session, const std::string& variant, const Review& review) {
    const std::string name = shown_name(session), digest = digest_of(session, variant);
    std::vector<std::string> parts;
    if (!name.empty()) parts.push_back("project " + name);
    if (!variant.empty()) parts.push_back(variant);
    parts.push_back(review_words(review));
    if (!digest.empty()) parts.push_back("model " + digest);
    return joined(parts);
}

}  // namespace vesselbench
