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
#include "geometry/vessel/openings/judged_tips.h"
#include "workbench/case/scene.h"
#include "workbench/findings/finding.h"
#include "workbench/findings/stated_ends.h"

namespace vesselbench {

/// A model in which artefacts are looked for, and what several detectors derive from it.
class FindingSubject {
public:
    /// \param stated of the ends; \pre the scene has a surface; both must outlive this
    explicit FindingSubject(const Scene& scene, std::span<const StatedEnd> stated = {})
        : scene_(scene), surface_(*scene.surface), stated_(stated) {}

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

    /// What a blind end is taken for: with the odds that were stated when the ends were decided,
    /// else with those of this surface. Empty: it was not judged. \throw as lines()
    [[nodiscard]] std::optional<EndVerdict> verdict_at(const Vec3& tip, const Progress& progress);

    [[nodiscard]] double mean_edge();  ///< [mm]

private:
    const Scene& scene_;
    const Surface& surface_;
    std::optional<Lines> lines_;
    std::string without_lines_;  ///< why; empty: not searched, or found
    std::optional<std::vector<WallSpot>> spots_;
    std::span<const StatedEnd> stated_;
    std::optional<std::vector<JudgedTip>> tips_;
    std::optional<double> mean_edge_;
};

/// One row of the registry. Nothing else lists the kinds by name.
struct Detector {
    const char* kind;     ///< "bump"; a plain name, part of ids
    const char* title;    ///< "Bump"
    const char* certain;  ///< what its certainty is of: "the wall rises there"
    /// It may follow from what earlier rows find: walls that touch are bent, too. Dropped where one
    /// of these, no less certain, lies beside it.
    bool follows;
    std::vector<Finding> (*find)(FindingSubject& subject, const Progress& progress);
};

/// All kinds of findings of this build, in the order in which they are looked for, and listed: what
/// makes a model useless comes before what makes it less exact.
[[nodiscard]] std::span<const Detector> detectors();

/// The title of a kind; the kind itself if this build does not know it.
[[nodiscard]] std::string title_of_kind(const std::string& kind);

/// What the certainty of a kind is of: "the wall rises there"; of an unknown one "it is there".
[[nodiscard]] std::string certain_of_kind(const std::string& kind);

/// The registration: each row `name` is a function
/// `std::vector<Finding> find_name(FindingSubject&, const Progress&)`. Columns: name, kind, title,
/// whether it follows from earlier rows, what its certainty is of.
// clang-format off
#define VESSELBENCH_DETECTORS(ROW) \
    ROW(self_intersections, "self-intersection", "Self-intersection", false, "the wall passes through itself") \
    ROW(detached_pieces,    "detached",          "Detached piece",    false, "the piece is not connected") \
    ROW(holes,              "hole",              "Hole in the wall",  false, "no vessel ends there") \
    ROW(handles,            "handle",            "Handle",            false, "vessels touch there") \
    ROW(contacts,           "contact",           "Contact",           true,  "the image cannot part the walls") \
    ROW(threads,            "thread",            "Thread",            false, "the image hardly shows the lumen") \
    ROW(oblique_ends,       "oblique-end",       "Oblique end",       false, "the cut is oblique") \
    ROW(frayed_ends,        "frayed-end",        "Frayed end",        false, "one vessel fades there") \
    ROW(narrow_vessels,     "narrowing",         "Narrowing",         true,  "the surface is narrower than beside it") \
    ROW(stubs,              "stub",              "Sac or stub",       true,  "a branch ends blind and short") \
    ROW(bumps,              "bump",              "Bump",              true,  "the wall rises there") \
    ROW(dents,              "dent",              "Dent",              true,  "the wall is pressed in there") \
    ROW(staircases,         "staircases",        "Staircases",        false, "slices made the steps")
// clang-format on

#define VESSELBENCH_DECLARE(name, kind, title, follows, certain) \
    [[nodiscard]] std::vector<Finding> find_##name(FindingSubject&, const Progress&);
VESSELBENCH_DETECTORS(VESSELBENCH_DECLARE)
#undef VESSELBENCH_DECLARE

}  // namespace vesselbench
