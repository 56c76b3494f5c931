#include "workbench/operations/shared/handle_warnings.h"

#include "geometry/kernel/handles.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// More handles are noise: their number says it.
constexpr int kMostNamed = 5;

/// A ring shorter than this many of its widths goes around less than a vessel does: a hole in a
/// contact.
constexpr double kShortest = 8.0;

std::string text_of(const SurfaceHandle& handle) {
    const std::string where = "the lumen has a handle at " + place_text(handle.centre) + ", " +
                              formatted(handle.width) + " mm wide and " + formatted(handle.length) +
                              " mm around: ";
    if (handle.length < kShortest * handle.width)
        return where + "so small a ring is an artefact; cleaning, or another threshold, removes it";
    return where +
           "if two vessels merely touch there, blood takes a way that does not exist; a true ring "
           "of vessels, such as the circle of Willis, stays";
}

}  // namespace

std::vector<std::string> handle_warnings(const Surface& surface, const Progress& progress) {
    const int genus = connectivity(*surface.topology).genus.value_or(0);
    if (genus <= 0) return {};
    if (genus > kMostNamed)
        return {"the lumen has " + counted(static_cast<std::size_t>(genus), "handle") +
                ": vessels touch, or noise is part of it; choose another threshold, or clean the "
                "image"};
    std::vector<std::string> warnings;
    for (const SurfaceHandle& handle : handles_of(surface, progress.silent()))
        warnings.push_back(text_of(handle));
    return warnings;
}

}  // namespace vesselbench
