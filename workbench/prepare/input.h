#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "workbench/prepare/recipe.h"

namespace vesselbench {

/// The user's INPUT.
struct InputOptions {
    std::string
        input;  ///< a surface, an image, a folder of DICOM slices or with case.json, a bundled case
    std::string mask;   ///< image file of labels or a level set; empty: none, or the case's own
    std::string units;  ///< "mm", "cm" or "m"; empty: as the file says, or the only one that fits
    /// Structures beside the vessel, each a surface file, or labels of the label map, "7" or "7,8",
    /// or the name of one of its segments.
    std::vector<std::string> neighbours = {};
    /// UTF-8, in the report and in messages; empty: the file's or the case's. A project keeps it.
    std::string name = {};
    std::string label = {};  ///< segments that are the vessel, "artery" or "1,2"; empty: not chosen
    std::string mask_is = {};  ///< "wall" or "region"; empty: a wall if it is drawn
};

/// The INPUT after inspection.
struct Input {
    bool is_image = false;
    std::string name;            ///< the given one, or the file's or case's without its folder
    bool is_renamed = false;     ///< the name was given: the report has it in place of files' names
    std::filesystem::path file;  ///< surface, image, or folder of DICOM slices
    std::filesystem::path mask;
    std::string units;
    std::string label;             ///< as given
    std::string mask_is;           ///< as given
    Recipe neighbours;             ///< the edits that load them
    std::optional<Surface> exact;  ///< the true surface, if a phantom provides it
    std::shared_ptr<const nlohmann::ordered_json> recipes;  ///< a case's own: by "cfd" and "rp"
    std::filesystem::path folder;      ///< of a case: what its recipes name is in it
    std::shared_ptr<const void> keep;  ///< folder of files made for this input; removed with it
};

/// True for a text that names a segment of a label map: no labels, and not named like a surface.
[[nodiscard]] bool names_segment(const std::string& neighbour);

/// Settings by which a mask is a region are as good as --mask-is region.
/// \param settings "operation.parameter=value"
void take_settings_of_mask(Input& input, std::span<const std::string> settings);

/// Inspects INPUT and reads the description of a case; of surfaces and images it determines only
/// the kind. A phantom's image and mask are created.
/// \throw IoError if it does not exist, InvalidInput if it is none of these, or a case names files
/// outside its folder
[[nodiscard]] Input resolve_input(const InputOptions& options, const Progress& progress);

/// The words of "when" that apply to the input.
[[nodiscard]] RecipeUse recipe_use(const Input& input, const std::string& purpose);

/// The case's own recipe for a purpose, a JSON list, with the paths of its files; null: it has
/// none. \throw InvalidInput if a file is outside the case's folder
[[nodiscard]] nlohmann::ordered_json own_recipe(const Input& input, const std::string& purpose);

/// The edits that load the input: the image or surface, then its neighbours.
/// \throw UsageError if a unit is unknown
[[nodiscard]] Recipe loading_entries(const Input& input);

/// The recipe of a purpose with the edits that load the input in front; an entry at its front that
/// loads the same kind keeps the arguments that the input does not give.
/// \param list of operations; null: the built-in recipe
/// \throw UsageError as recipe_from_json(), or if a unit is unknown
[[nodiscard]] Recipe input_recipe(const Input& input, const std::string& purpose,
                                  const nlohmann::ordered_json& list);

}  // namespace vesselbench
