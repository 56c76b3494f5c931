#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/forest/plan.h"
#include "tests/forest/tree.h"

namespace vesselbench::forest {

/// What truth.json says of a case. Lengths in mm, LPS; docs/science/forest.md describes the fields.
struct Truth {
    struct Branch {
        Line line;  ///< up to the node or the true end
        std::optional<std::size_t> end;
        double free_from = 0.0;  ///< [mm]
        bool resolved = true;

        /// Of the part outside the vessel it leaves [mm].
        [[nodiscard]] double free_length() const { return length_of(line) - free_from; }

        [[nodiscard]] double diameter() const { return 2.0 * line[line.size() / 2].radius; }
    };

    struct TrueEnd : End {
        std::size_t branch = 0;
    };

    std::uint64_t seed = 0;
    std::string kind;      ///< to_string(CaseKind)
    std::string features;  ///< "loops kisses sacs", for the table
    std::string file;
    std::vector<std::string> arguments;  ///< of `prepare`, besides the input
    double resolution = 0.0;     ///< edge of the triangles, or half the voxel's diagonal [mm]
    int genus = 0;               ///< loops of the vessels
    bool cfd = true, rp = true;  ///< can be expected
    std::vector<Branch> branches;
    std::vector<TrueEnd> ends;
    std::vector<Sac> sacs;
    std::vector<Kiss> kisses;
};

[[nodiscard]] Truth truth_of(const Tree& tree, const Plan& plan);
[[nodiscard]] nlohmann::ordered_json to_json(const Truth& truth);
[[nodiscard]] Truth truth_from(const nlohmann::ordered_json& json);

}  // namespace vesselbench::forest
