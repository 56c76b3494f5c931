#include "workbench/session/export_record.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/project.h"

namespace vesselbench {

bool record_export(Session& session, const std::filesystem::path& file,
                   const std::string& variant) {
    if (!session.read_only_reason().empty()) return false;
    nlohmann::ordered_json facts = {{"variant", variant},
                                    {"state", session.snapshot()->history->current()},
                                    {"sha256", hash_of_file(file)}};
    for (const LogEntry& entry : session.log(variant))
        if (entry.result) facts["model"] = session.project().digest(entry.result->id);
    const auto whole = std::filesystem::absolute(file).lexically_normal();
    const auto named = whole.has_filename() ? whole : whole.parent_path();
    session.record({.kind = "export", .subject = bare_name(named), .facts = text_from_json(facts)});
    return true;
}

}  // namespace vesselbench
