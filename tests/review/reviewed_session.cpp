#include "tests/review/reviewed_session.h"

#include <filesystem>

#include "geometry/kernel/whole_file.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/project/project.h"

namespace vesselbench::test {

std::string reviewed_project() {
    const std::string file = temporary_folder() + "/case.vbench";
    Session session = Session::create(file, options());
    session.apply("make-sphere", {{"levels", std::int64_t{2}}});
    session.apply("bump", {{"at", kTop}, {"reach", 4.0}, {"height", 0.5}});
    session.apply("bump", {{"at", kTop}, {"reach", 4.0}, {"height", 0.25}});
    return file;
}

VerdictFile verdicts_on(const Session& session, const std::string& reviewer, Verdict verdict,
                        const std::string& written) {
    VerdictFile file{.program = "page",
                     .project = session.project().id(),
                     .project_name = session.project().name(),
                     .chain_head = session.project().record_head(),
                     .reviewer = reviewer,
                     .role = "radiologist",
                     .written = written,
                     .overall = verdict,
                     .overall_comment = "as a whole"};
    for (const LogEntry& entry : session.log())
        file.edits.push_back({.edit = entry.edit.edit,
                              .hash = edit_hash(session.project(), entry),
                              .verdict = verdict,
                              .comment = "because",
                              .time = written});
    return file;
}

std::string save_verdicts(const std::string& project, const VerdictFile& verdicts) {
    static int count = 0;
    const auto path = std::filesystem::path(project).parent_path() /
                      ("verdicts" + std::to_string(++count) + ".json");
    write_file(path, text_of(verdicts));
    return path.string();
}

}  // namespace vesselbench::test
