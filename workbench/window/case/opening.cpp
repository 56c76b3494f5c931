#include "workbench/window/case/opening.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/prepare/kept_recipe.h"
#include "workbench/prepare/prepare.h"
#include "workbench/session/stored_texts.h"
#include "workbench/window/case/preparation.h"
#include "workbench/window/case/user_folders.h"

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

/// What a reopened project knows of its input: the recipes it keeps, unless they cannot be used.
std::optional<Input> remembered_input(const fs::path& project, std::vector<Message>& remarks) {
    try {
        Input input;
        input.folder = case_folder(project);
        if (const std::string text = stored_text(project, StoredText::Recipes); !text.empty())
            input.recipes = std::make_shared<const Json>(json_from_text(text, "the stored recipe"));
        take_kept_recipes(input, project);
        if (!input.recipes) return std::nullopt;
        check_recipes(input);
        return input;
    } catch (const std::exception& error) {
        remarks.push_back(
            make_message({.code = "recipe-unusable", .words = {{"reason", error.what()}}}));
        return std::nullopt;
    }
}

Opened open_project(const fs::path& project, const SessionOptions& options) {
    Opened opened{.session = Session::open(project, options), .project = project};
    opened.input = remembered_input(project, opened.remarks);
    opened.prepared = prepared_purposes(project);
    const std::string reason = opened.session.read_only_reason();
    if (!reason.empty())
        opened.remarks.push_back(make_message(MessageKind::Remark, "read-only: " + reason));
    return opened;
}

/// A project that was made from a file before; none if it has not read just this content, cannot be
/// opened, or, unless it is the open one, cannot be written.
std::optional<Opened> earlier_project(const fs::path& file, const OpenRequest& request,
                                      const SessionOptions& options) {
    std::error_code ignored;
    try {
        Opened opened = open_project(file, options);
        opened.is_open = fs::equivalent(file, request.open_project, ignored);
        if (!opened.is_open && !opened.session.read_only_reason().empty()) return std::nullopt;
        if (!opened.session.is_source(request.path)) return std::nullopt;
        opened.made_before = request;
        return opened;
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception&) {  // a damaged one is not the answer
        return std::nullopt;
    }
}

/// The project that was made from a file before, where the window puts projects: the open one, else
/// the newest.
std::optional<Opened> open_earlier(const OpenRequest& request, const SessionOptions& options) {
    std::error_code ignored;
    if (request.anew || !fs::is_regular_file(request.path, ignored)) return std::nullopt;
    auto files = earlier_project_files(request.path, request.beside_input, request.documents);
    std::ranges::stable_partition(files, [&](const fs::path& file) {
        return fs::equivalent(file, request.open_project, ignored);
    });
    for (const fs::path& file : files)
        if (auto opened = earlier_project(file, request, options)) return opened;
    return std::nullopt;
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
    return {.session = std::move(session),
            .project = project,
            .is_new = true,
            .input = input,
            .remarks = std::move(remarks)};
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
    if (request.path.extension() == ".vbench") return open_project(request.path, options);
    if (auto earlier = open_earlier(request, options)) return std::move(*earlier);
    return open_input(request.path,
                      new_project_file(request.path, request.beside_input, request.documents),
                      options, progress);
}

}  // namespace vesselbench
