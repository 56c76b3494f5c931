#include "workbench/window/model/opening.h"

#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/prepare/prepare.h"
#include "workbench/session/stored_texts.h"
#include "workbench/window/model/preparation.h"
#include "workbench/window/model/user_folders.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A case folder that describes a built-in phantom, for as long as it lives.
class PhantomFolder {
public:
    explicit PhantomFolder(const std::string& phantom) {
        std::string name = (fs::temp_directory_path() / "vesselbench-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw IoError("cannot create a temporary folder in '" +
                          fs::temp_directory_path().string() + "'");
        made_ = name;
        fs::create_directory(folder());
        write_file(folder() / "case.json", Json({{"name", phantom}, {"phantom", phantom}}).dump());
    }

    ~PhantomFolder() {
        std::error_code ignored;
        fs::remove_all(made_, ignored);
    }

    PhantomFolder(const PhantomFolder&) = delete;
    PhantomFolder& operator=(const PhantomFolder&) = delete;

    [[nodiscard]] fs::path folder() const { return made_ / "case"; }

private:
    fs::path made_;
};

/// \throw UsageError, or an exception of JSON, if the recipe of a purpose cannot be used
void check_recipes(const Input& input) {
    for (const Purpose& purpose : purposes()) {
        const Json own = own_recipe(input, purpose.name);
        if (!own.is_null())
            static_cast<void>(recipe_from_json(own, recipe_use(input, purpose.name)));
    }
}

/// Where the files of a reopened project's recipes are.
/// \throw InvalidInput if the project says that they are outside its folder
fs::path case_folder(const fs::path& project) {
    const fs::path beside = fs::absolute(project).parent_path();
    const std::string stored = stored_text(project, StoredText::CaseFolder);
    return stored.empty() ? beside : inner_file(beside, stored, "the case's folder");
}

/// What a reopened project knows of its input: its own recipes, unless they cannot be used.
std::optional<Input> remembered_input(const fs::path& project, std::vector<Message>& remarks) {
    try {
        const std::string text = stored_text(project, StoredText::Recipes);
        if (text.empty()) return std::nullopt;
        Input input;
        input.folder = case_folder(project);
        input.recipes = std::make_shared<const Json>(json_from_text(text, "the stored recipe"));
        check_recipes(input);
        return input;
    } catch (const std::exception& error) {
        remarks.push_back(
            make_message({.code = "recipe-unusable", .words = {{"reason", error.what()}}}));
        return std::nullopt;
    }
}

Opened open_project(const OpenRequest& request, const SessionOptions& options) {
    Opened opened{.session = Session::open(request.path, options), .project = request.path};
    opened.input = remembered_input(request.path, opened.remarks);
    opened.prepared = prepared_purposes(request.path);
    const std::string reason = opened.session.read_only_reason();
    if (!reason.empty())
        opened.remarks.push_back(make_message(MessageKind::Remark, "read-only: " + reason));
    return opened;
}

Opened open_input(const fs::path& path, const fs::path& project, const SessionOptions& options,
                  const Progress& progress) {
    Input input = resolve_input({.input = path.string()}, progress.part(0.0, 0.4));
    // The window shows the doubt, and the edit's units can be changed there.
    if (!input.is_image && input.units.empty()) input.units = "guess";
    try {
        check_recipes(input);
    } catch (const std::exception& error) {
        throw InvalidInput("case '" + input.name + "': its recipe cannot be used: " + error.what());
    }
    std::vector<Message> remarks;
    const Teller tell([&](const std::string& text) { remarks.push_back(message_from(text)); },
                      [&](const Diagnostic& warning) { remarks.push_back(make_message(warning)); });
    Session session = start_project(project, input, options, tell, progress.part(0.4, 1.0));
    return {std::move(session), project, true, input, std::move(remarks), {}};
}

Opened open_phantom(const OpenRequest& request, const SessionOptions& options,
                    const Progress& progress) {
    const PhantomFolder phantom(request.phantom);
    const fs::path project = new_project_file(request.phantom, false, request.documents);
    return open_input(phantom.folder(), project, options, progress);
}

}  // namespace

std::string OpenRequest::name() const {
    if (!phantom.empty()) return phantom;
    return (path.has_filename() ? path : path.parent_path()).filename().string();
}

Opened open_case(const OpenRequest& request, const SessionOptions& options,
                 const Progress& progress) {
    progress.report(0.0, "opening " + request.name());
    if (!request.phantom.empty()) return open_phantom(request, options, progress);
    if (!fs::exists(request.path)) throw IoError("'" + request.name() + "' does not exist");
    if (request.path.extension() == ".vbench") return open_project(request, options);
    return open_input(request.path,
                      new_project_file(request.path, request.beside_input, request.documents),
                      options, progress);
}

}  // namespace vesselbench
