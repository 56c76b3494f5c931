#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace vesselbench {

/// What a model is made for: `prepare --for`, and a word of recipes.
struct Purpose {
    std::string name;                        ///< "cfd"
    std::string title;                       ///< of the report: "Model for flow simulation"
    std::vector<std::string> words = {};     ///< `prepare --for` takes them too: "flow"
    std::string help;                        ///< with its name and words: "flow simulation (cfd)"
    std::string summary;                     ///< what is special about the model, one line
    std::vector<std::string> products = {};  ///< file names, besides those of the surface
    std::string result = "surface";          ///< what the user asked for
    std::string result_file = "surface.vtp";
    bool simulates_flow = false;  ///< the report describes volume mesh and flow
    /// Relevance of small features, spatial relations, smoothness, high resolution, triangle
    /// quality and triangle size homogeneity: '+' high, 'o' medium, '-' low (thesis Table 2.1).
    std::array<char, 6> relevance = {'-', '-', '-', '-', '-', '-'};
};

/// All purposes.
[[nodiscard]] std::span<const Purpose> purposes();

[[nodiscard]] std::vector<std::string> purpose_names();

/// The name of the purpose that has this name or word; what is neither, as it is.
[[nodiscard]] std::string purpose_name(const std::string& word);

/// The model that a variant is: a purpose's title; a variant of the user's is called by its name.
[[nodiscard]] std::string model_title(const std::string& variant);

/// \throw UsageError that lists the purposes if there is none of this name
[[nodiscard]] const Purpose& find_purpose(const std::string& name);

}  // namespace vesselbench
