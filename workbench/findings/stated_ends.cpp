#include "workbench/findings/stated_ends.h"

#include <limits>
#include <utility>

#include "workbench/operations/clip_opening/clipping_record.h"

namespace vesselbench {

std::vector<StatedEnd> stated_ends(const std::vector<LogEntry>& log) {
    std::vector<StatedEnd> stated;
    for (const LogEntry& entry : log) {
        if (!entry.result) continue;
        std::vector<StatedEnd> ends;
        for (const ReportedEnd& end : reported_ends(entry.result->report))
            if (end.odds) ends.push_back({end.place, end.odds->vessel_diameter, end.odds->odds});
        if (!ends.empty()) stated = std::move(ends);  // whoever decides again, decides all of them
    }
    return stated;
}

const StatedEnd* stated_at(std::span<const StatedEnd> stated, const Vec3& place, double diameter) {
    constexpr double kAlike = 2.0;  // widths
    const StatedEnd* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const StatedEnd& end : stated) {
        const double away = (end.place - place).norm();
        const bool alike = diameter < kAlike * end.diameter && end.diameter < kAlike * diameter;
        if (!alike || away > end.diameter || away >= least) continue;
        least = away;
        nearest = &end;
    }
    return nearest;
}

}  // namespace vesselbench
