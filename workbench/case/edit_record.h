#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "workbench/case/history.h"

namespace vesselbench {

/// Figures of an edit's effect on the surface. Empty if there was no surface to measure.
struct SurfaceChange {
    std::optional<double> volume_before;      ///< [mm^3], openings closed virtually
    std::optional<double> volume_after;       ///< [mm^3]
    std::optional<double> largest_deviation;  ///< [mm], between the old surface and the new
    std::optional<double> mean_deviation;     ///< [mm]
    std::size_t triangles_before = 0;
    std::size_t triangles_after = 0;
    std::size_t moved_vertices = 0;  ///< if the connectivity was kept

    bool operator==(const SurfaceChange&) const = default;
};

/// The variant of edits of steps 4-8, and of scenes, where none is named.
inline constexpr const char* kDefaultVariant = "cfd";

/// The user's request: one revision of an edit.
struct EditRecord {
    EditRef edit;
    EditPlace place;
    std::string operation;
    Arguments given;  ///< file arguments contain the file's name without its folder
    std::string author;
    std::string time;  ///< UTC, 2024-05-17T09:30:00Z
    std::string note;

    bool operator==(const EditRecord&) const = default;
};

/// The result of running it on a certain input.
struct ResultRecord {
    ResultId id = 0;
    EditRef edit;
    ResultId input = 0;
    std::string stale_reason;
    Arguments resolved;
    std::vector<Diagnostic> warnings;  ///< of a stale result: the errors that its reason words
    std::string report;                ///< JSON; may be empty
    SurfaceChange change;
    double duration = 0.0;        ///< [s]
    std::string time;             ///< when it ran, UTC
    std::string program_version;  ///< of vesselbench
    std::string device;           ///< "cpu" or "gpu", as Outcome::device
};

}  // namespace vesselbench
