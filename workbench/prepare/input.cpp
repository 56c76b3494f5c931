#include "workbench/prepare/input.h"

#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/phantoms/phantom.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/operations/table.h"
#include "workbench/phantoms/phantom_json.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kCaseFile = "case.json";

/// A new folder for files with the lifetime of the input.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "vesselbench-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw IoError("cannot create a temporary folder in '" +
                          fs::temp_directory_path().string() + "'");
        path_ = name;
    }

    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

fs::path plain_path(const std::string& text) {
    fs::path path(text);
    return path.has_filename() ? path : path.parent_path();  // "cases/aneurysm/"
}

void make_phantom_files(Input& input, const Json& json, const Progress& progress) {
    PhantomDescription description = builtin_phantom(json["phantom"].get<std::string>());
    description.seed = json.value("seed", description.seed);
    const Phantom phantom = make_phantom(description, progress);
    const auto folder = std::make_shared<TemporaryFolder>();
    input.keep = folder;
    input.is_image = true;
    input.file = folder->path() / (description.name + ".nrrd");
    input.mask = folder->path() / (description.name + "_mask.nrrd");
    write_image(input.file.string(), phantom.image);
    write_image(input.mask.string(), phantom.mask);
    input.exact = phantom.exact;
}

fs::path case_file(const fs::path& folder, const Json& json, const char* key) {
    const fs::path file = folder / json[key].get<std::string>();
    if (!fs::exists(file))
        throw IoError("case '" + folder.filename().string() + "': its " + key + " '" +
                      file.filename().string() + "' does not exist");
    return file;
}

void fill_from_case(Input& input, const fs::path& folder, const Json& json,
                    const Progress& progress) {
    input.name = json.value("name", input.name);
    input.units = json.value("units", "");
    if (json.contains("recipe")) input.recipes = std::make_shared<const Json>(json["recipe"]);
    if (json.contains("phantom")) return make_phantom_files(input, json, progress);
    input.is_image = json.contains("image");
    if (!input.is_image && !json.contains("surface"))
        throw InvalidInput("case '" + input.name +
                           "': case.json has no \"image\", \"surface\" or \"phantom\"");
    input.file = case_file(folder, json, input.is_image ? "image" : "surface");
    if (json.contains("mask")) input.mask = case_file(folder, json, "mask");
    if (json.contains("exact"))
        input.exact = read_foreign_surface(case_file(folder, json, "exact").string(), input.units);
}

void read_case(Input& input, const fs::path& folder, const Progress& progress) {
    try {
        const Json json = Json::parse(file_content(folder / kCaseFile));
        fill_from_case(input, folder, json, progress);
    } catch (const nlohmann::json::exception& error) {
        throw InvalidInput("case '" + folder.filename().string() +
                           "': case.json cannot be used: " + error.what());
    } catch (const UsageError& error) {
        throw InvalidInput("case '" + folder.filename().string() + "': " + error.what());
    }
}

}  // namespace

Input resolve_input(const InputOptions& options, const Progress& progress) {
    Input input;
    const fs::path path = plain_path(options.input);
    input.name = path.filename().string();
    if (!fs::exists(path)) throw IoError("'" + input.name + "' does not exist");
    if (fs::exists(path / kCaseFile)) {
        read_case(input, path, progress);
    } else {
        input.is_image = fs::is_directory(path) || !holds_surface(path.string());
        input.file = path;
    }
    if (!options.mask.empty()) input.mask = options.mask;
    if (!options.units.empty()) input.units = options.units;
    if (!input.mask.empty() && !fs::exists(input.mask))
        throw IoError("the mask '" + input.mask.filename().string() + "' does not exist");
    if (!input.mask.empty() && !input.is_image)
        throw UsageError("--mask requires an image, but '" + input.name + "' is a surface");
    return input;
}

RecipeUse recipe_use(const Input& input, const std::string& purpose) {
    RecipeUse use = {input.is_image ? "image" : "surface", purpose};
    if (!input.mask.empty()) use.push_back("mask");
    return use;
}

Json own_recipe(const Input& input, const std::string& purpose) {
    if (!input.recipes) return nullptr;
    if (input.recipes->is_array()) return *input.recipes;
    return input.recipes->value(purpose, Json());
}

RecipeEntry loading_entry(const Input& input) {
    const InputKind kind = input.is_image ? InputKind::Image : InputKind::Surface;
    RecipeEntry entry{.given = GivenArguments(loading_operation(kind))};
    entry.given.set("file", input.file.string());
    if (!input.mask.empty()) entry.given.set("mask", input.mask.string());
    if (!input.units.empty()) entry.given.set("units", input.units);
    return entry;
}

}  // namespace vesselbench
