#include "workbench/prepare/input.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/image_formats.h"
#include "geometry/formats/surface_file.h"
#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/regular_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "geometry/phantoms/phantom.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/operations/table.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/prepare/case_files.h"
#include "workbench/prepare/entry_reader.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRegion = "region";

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

/// A name that is no file may be that of a bundled case; the folder that was made of the case is no
/// input.
fs::path input_path(const std::string& text) {
    const fs::path path = plain_path(text);
    const bool is_input = file_exists(path) && !file_exists(path / kProjectFile);
    const fs::path bundled = is_input ? fs::path() : bundled_case(text);
    return bundled.empty() ? path : bundled;
}

void make_phantom_files(Input& input, PhantomDescription description, const Progress& progress) {
    const Phantom phantom = make_phantom(description, progress);
    const auto folder = std::make_shared<TemporaryFolder>();
    input.keep = folder;
    input.is_image = true;
    input.file = folder->path() / (description.name + ".nrrd");
    input.mask = folder->path() / (description.name + "_mask.nrrd");
    write_image(input.file.string(), phantom.image, progress);
    write_image(input.mask.string(), phantom.mask, progress);
    input.exact = phantom.exact;
}

void check_recipes(const Json& recipes, const fs::path& folder) {
    if (!recipes.is_array() && !recipes.is_object())
        refuse_json(recipes, "case.json.recipe",
                    "a list of operations, or an object with such a list for each purpose");
    if (recipes.is_array()) return void(recipe_in(folder, recipes));
    for (const Json& recipe : recipes) static_cast<void>(recipe_in(folder, recipe));
}

void fill_from_case(Input& input, const fs::path& folder, const Json& json,
                    const Progress& progress) {
    JsonFields fields(json, kCaseFile);
    fields.read("name", input.name);
    fields.read("units", input.units);
    if (const Json* recipes = fields.child("recipe")) {
        check_recipes(*recipes, folder);
        input.folder = folder;
        input.recipes = std::make_shared<const Json>(*recipes);
    }
    if (const auto phantom = fields.optional<std::string>("phantom")) {
        PhantomDescription description = builtin_phantom(*phantom);
        fields.read("seed", description.seed);
        return make_phantom_files(input, std::move(description), progress);
    }
    const fs::path image = case_file(folder, fields, "image");
    input.is_image = !image.empty();
    input.file = input.is_image ? image : case_file(folder, fields, "surface");
    if (input.file.empty())
        throw InvalidInput("case.json has no \"image\", \"surface\" or \"phantom\"");
    input.mask = case_file(folder, fields, "mask");
    if (const fs::path exact = case_file(folder, fields, "exact"); !exact.empty())
        input.exact = read_foreign_surface(exact.string(), input.units);
}

void read_case(Input& input, const fs::path& folder, const Progress& progress) {
    const std::string place = "case '" + folder.filename().string() + "': ";
    try {
        fill_from_case(input, folder, json_from_file(folder / kCaseFile, JsonComments::Ignored),
                       progress);
    } catch (const InvalidInput& error) {
        throw InvalidInput(place + error.what());
    } catch (const UsageError& error) {
        throw InvalidInput(place + error.what());
    } catch (const IoError& error) {
        throw IoError(place + error.what());
    }
}

/// What is no surface has to be an image.
void require_known_image(const fs::path& path) {
    if (fs::is_directory(path) || row_that_reads(image_formats(), path.string()) != nullptr) return;
    throw InvalidInput("'" + path.filename().string() + "' is neither a surface (" +
                       enumerated(read_suffixes(surface_formats())) + ") nor an image: give " +
                       image_formats_text());
}

/// "7" or "7,8": labels and no file.
bool is_label_list(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789,") == std::string::npos &&
           !file_exists(text);
}

/// The edits that load the neighbours, each named after its file or its labels; after neither if
/// the input has a name of its own, which is given where files' names are private.
Recipe neighbour_entries(const InputOptions& options, bool of_image) {
    Recipe entries;
    PlainNames names;
    const auto named = [&](const std::string& usual) {
        return options.name.empty() ? names.add(usual)
                                    : "neighbour-" + std::to_string(entries.size() + 1);
    };
    for (const std::string& neighbour : options.neighbours) {
        RecipeEntry entry{.given = GivenArguments(loading_operation(InputKind::Neighbour))};
        if (is_label_list(neighbour)) {
            if (!of_image)
                throw UsageError("--neighbour " + neighbour +
                                 ": labels need a label map, but the input is a surface");
            entry.given.set("name", named("label-" + neighbour));
            entry.given.set("labels", neighbour);
        } else if (of_image && names_segment(neighbour)) {
            entry.given.set("name", named(neighbour));
            entry.given.set("segment", neighbour);
        } else {
            const fs::path file = neighbour;
            if (!file_exists(file))
                throw IoError("the neighbour '" + file.filename().string() + "' does not exist");
            entry.given.set("name", named(file.stem().string()));
            entry.given.set("file", neighbour);
            if (!options.units.empty()) entry.given.set("units", options.units);
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// The edit that loads the image or surface.
RecipeEntry source_entry(const Input& input) {
    const InputKind kind = input.is_image ? InputKind::Image : InputKind::Surface;
    RecipeEntry entry{.given = GivenArguments(loading_operation(kind))};
    entry.given.set("file", input.file.string());
    if (!input.mask.empty()) entry.given.set("mask", input.mask.string());
    if (!input.units.empty()) entry.given.set("units", input.units);
    if (!input.label.empty()) entry.given.set("label", input.label);
    return entry;
}

}  // namespace

bool names_segment(const std::string& neighbour) {
    const auto is_named = [&](const SurfaceFormat& format) {
        return is_named_for_reading(format, neighbour);
    };
    return !neighbour.empty() && neighbour.find('/') == std::string::npos &&
           !is_label_list(neighbour) && std::ranges::none_of(surface_formats(), is_named);
}

void take_settings_of_mask(Input& input, std::span<const std::string> settings) {
    if (input.mask_is.empty() && std::ranges::any_of(settings, limits_region))
        input.mask_is = kRegion;
}

Input resolve_input(const InputOptions& options, const Progress& progress) {
    Input input;
    const fs::path path = input_path(options.input);
    input.name = path.filename().string();
    if (!file_exists(path)) throw IoError("'" + input.name + "' does not exist");
    refuse_special_file(path);
    if (file_exists(path / kCaseFile)) {
        read_case(input, path, progress);
    } else {
        // A folder of DICOM slices is often called after the patient.
        if (fs::is_directory(path)) input.name = "DICOM slices";
        input.is_image = fs::is_directory(path) || !holds_surface(path.string());
        input.file = path;
        if (input.is_image) require_known_image(path);
    }
    input.is_renamed = !options.name.empty();
    if (input.is_renamed) input.name = options.name;
    if (!options.mask.empty()) input.mask = options.mask;
    if (!options.units.empty()) input.units = options.units;
    if (!input.mask.empty() && !file_exists(input.mask))
        throw IoError("the mask '" + input.mask.filename().string() + "' does not exist");
    input.label = options.label;
    input.mask_is = options.mask_is;
    if (!input.label.empty() && !input.is_image)
        throw UsageError("--label chooses segments of a label map, but '" + input.name +
                         "' is a surface");
    if (!input.mask.empty() && !input.is_image)
        throw UsageError("--mask requires an image, but '" + input.name + "' is a surface");
    input.neighbours = neighbour_entries(options, input.is_image);
    return input;
}

RecipeUse recipe_use(const Input& input, const std::string& purpose) {
    RecipeUse use = {input.is_image ? "image" : "surface", purpose};
    if (!input.mask.empty()) use.emplace_back("mask");
    if (!input.mask.empty() && input.mask_is != kRegion)
        use.emplace_back(input.mask_is.empty() ? kDrawnMask : kWallMask);
    return use;
}

Json own_recipe(const Input& input, const std::string& purpose) {
    if (!input.recipes) return nullptr;
    if (input.recipes->is_array()) return recipe_in(input.folder, *input.recipes);
    if (!input.recipes->is_object())
        throw UsageError("the recipes are neither a list nor an object");
    return recipe_in(input.folder, input.recipes->value(purpose, Json()));
}

Recipe loading_entries(const Input& input) {
    Recipe entries = {source_entry(input)};
    entries.insert(entries.end(), input.neighbours.begin(), input.neighbours.end());
    return entries;
}

Recipe input_recipe(const Input& input, const std::string& purpose, const Json& list) {
    const RecipeUse use = recipe_use(input, purpose);
    Recipe recipe = list.is_null() ? default_recipe(use) : recipe_from_json(list, use);
    Recipe loading = loading_entries(input);
    if (!recipe.empty() &&
        &recipe.front().given.operation() == &loading.front().given.operation()) {
        RecipeEntry own = recipe.front();
        own.given.set(loading.front().given);
        loading.front() = std::move(own);
        recipe.erase(recipe.begin());
    }
    recipe.insert(recipe.begin(), loading.begin(), loading.end());
    return recipe;
}

}  // namespace vesselbench
