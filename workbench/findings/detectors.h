#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/artefacts/wall_relief.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/centerlines/stubs.h"
#include "workbench/case/scene.h"
#include "workbench/findings/finding.h"

namespace vesselbench {

/// A model in which artefacts are looked for, and what several detectors derive from it.
class FindingSubject {
public:
    /// \pre the scene has a surface; it must outlive this
    explicit FindingSubject(const Scene& scene) : scene_(scene), surface_(*scene.surface) {}

    [[nodiscard]] const Scene& scene() const { return scene_; }

    [[nodiscard]] const Surface& surface() const { return surface_; }

    struct Lines {
        std::shared_ptr<const CenterlineGraph> graph;
        std::shared_ptr<const std::vector<Stub>> stubs;
    };

    /// Whether the surface has centerlines. \throw Cancelled
    [[nodiscard]] bool has_lines(const Progress& progress);

    /// Found once.
    /// \throw AlgorithmFailure, each time, if the surface has no centerlines; Cancelled
    [[nodiscard]] const Lines& lines(const Progress& progress);

    /// Found once. \throw as lines()
    [[nodiscard]] const std::vector<WallSpot>& spots(const Progress& progress);

    [[nodiscard]] double mean_edge();  ///< [mm]

private:
    const Scene& scene_;
    const Surface& surface_;
    std::optional<Lines> lines_;
    std::string without_lines_;  ///< why; empty: not searched, or found
    std::optional<std::vector<WallSpot>> spots_;
    std::optional<double> mean_edge_;
};

/// One row of the registry. Nothing else lists the kinds by name.
struct Detector {
    const char* kind;   ///< "bump"; a plain name, part of ids
    const char* title;  ///< "Bump"
    /// It may follow from what earlier rows find: walls that touch are bent, too. Dropped where one
    /// of these, no less certain, lies beside it.
    bool follows;
    std::vector<Finding> (*find)(FindingSubject& subject, const Progress& progress);
};

/// All kinds of findings of this build, in the order in which they are looked for.
[[nodiscard]] std::span<const Detector> detectors();

/// The title of a kind; the kind itself if this build does not know it.
[[nodiscard]] std::string title_of_kind(const std::string& kind);

/// The registration: each row `name` is a function
/// `std::vector<Finding> find_name(FindingSubject&, const Progress&)`. Columns: name, kind, title,
/// whether it follows from earlier rows.
// clang-format off
#define VESSELBENCH_DETECTORS(ROW) \
    ROW(self_intersections, "self-intersection", "Self-intersection", false) \
    ROW(detached_pieces,    "detached",          "Detached piece",    false) \
    ROW(holes,              "hole",              "Hole in the wall",  false) \
    ROW(handles,            "handle",            "Handle",            false) \
    ROW(contacts,           "contact",           "Contact",           true) \
    ROW(threads,            "thread",            "Thread",            false) \
    ROW(oblique_ends,       "oblique-end",       "Oblique end",       false) \
    ROW(frayed_ends,        "frayed-end",        "Frayed end",        false) \
    ROW(narrow_vessels,     "narrowing",         "Narrowing",         true) \
    ROW(stubs,              "stub",              "Stub",              true) \
    ROW(bumps,              "bump",              "Bump",              true) \
    ROW(dents,              "dent",              "Dent",              true) \
    ROW(staircases,         "staircases",        "Staircases",        false)
// clang-format on

#define VESSELBENCH_DECLARE(name, kind, title, follows) \
    [[nodiscard]] std::vector<Finding> find_##name(FindingSubject&, const Progress&);
VESSELBENCH_DETECTORS(VESSELBENCH_DECLARE)
#undef VESSELBENCH_DECLARE

}  // namespace vesselbench
