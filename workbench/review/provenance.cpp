#include "workbench/review/provenance.h"

#include <filesystem>

#include "geometry/kernel/wording.h"
#include "workbench/project/project.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

constexpr std::size_t kDigits = 12;

std::string digest_of(const Session& session, const std::string& variant) {
    std::string digest;
    for (const LogEntry& entry : session.log(variant))
        if (entry.result) digest = session.project().digest(entry.result->id);
    return digest.substr(0, kDigits);
}

}  // namespace

std::string shown_name(const ProjectFile& project) {
    if (project.name().empty()) return "";
    const std::string given = stored_text(project.folder() / project.name(), StoredText::InputName);
    return given.empty() ? std::filesystem::path(project.name()).stem().string() : given;
}

std::string provenance(const Session& session, const std::string& variant, const Review& review) {
    const std::string name = shown_name(session.project()), digest = digest_of(session, variant);
    std::vector<std::string> parts;
    if (!name.empty()) parts.push_back("project " + name);
    if (!variant.empty()) parts.push_back(variant);
    parts.push_back(review_words(review));
    if (!digest.empty()) parts.push_back("model " + digest);
    return joined(parts);
}

}  // namespace vesselbench
