#include "tests/forest/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "tests/forest/grow.h"

namespace vesselbench::forest {

namespace {

using Json = nlohmann::ordered_json;

/// Largest angle of a cap off the perpendicular [deg]; voxels and triangles do not show more than
/// their size beside the vessel's.
constexpr double kMostTilt = 2.0;

double most_tilt(double resolution, double diameter) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    return std::max(kMostTilt, std::atan(resolution / diameter) * kDegrees);
}

/// The centerline's direction at a cut is known to this fraction of a diameter along it.
constexpr double kWhere = 0.25;
/// Vessels longer than this many diameters must not be lost, and how much of them may be.
constexpr double kLongBranch = 3.0;
constexpr double kLostShare = 0.1;
/// A centerline may be outside the result's wall by this fraction of its radius.
constexpr double kBesideShare = 0.3;

double degrees_between(const Vec3& a, const Vec3& b) {
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// The place of a line nearest to a point.
struct Foot {
    double abscissa = 0.0;
    double distance = std::numeric_limits<double>::infinity();  ///< [mm]
    double radius = 1.0;
};

Foot foot_of(const Vec3& p, const Line& line) {
    Foot best;
    double s = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 axis = line[i + 1].at - line[i].at;
        const double length = axis.norm();
        const double u =
            std::clamp((p - line[i].at).dot(axis) / std::max(length * length, 1e-18), 0.0, 1.0);
        const double distance = (p - line[i].at - u * axis).norm();
        if (distance < best.distance)
            best = {s + u * length, distance,
                    line[i].radius + u * (line[i + 1].radius - line[i].radius)};
        s += length;
    }
    return best;
}

/// An opening of the result.
struct Opening {
    std::string name;
    bool inlet = false;
    Vec3 place = Vec3::Zero();   ///< where the vessel was cut, before it was lengthened
    Vec3 normal = Vec3::Zero();  ///< outward
    double diameter = 0.0;
    std::optional<std::size_t> end;  ///< of the truth
    double cut_at = 0.0;             ///< on its branch's line [mm]
    double tilt = 0.0;               ///< [deg]
    double doubt = 0.0;              ///< standard deviation of its direction, as it was told [deg]
};

/// Lengths of the tubes added by extrude-opening, by opening.
std::map<std::string, double> tube_lengths(const Json& report) {
    std::map<std::string, double> lengths;
    for (const Json& step : report.value("steps", Json::array())) {
        if (step.value("operation", "") != "extrude-opening" || !step.contains("report")) continue;
        for (const Json& opening : step["report"].value("openings", Json::array()))
            lengths[opening.value("name", "")] += opening.value("length_mm", 0.0);
    }
    return lengths;
}

/// What clip-opening says of the direction of each opening it cut, by name: its standard deviation
/// [deg].
std::map<std::string, double> told_doubts(const Json& report) {
    std::map<std::string, double> doubts;
    for (const Json& step : report.value("steps", Json::array())) {
        if (step.value("operation", "") != "clip-opening" || !step.contains("report")) continue;
        for (const Json& end : step["report"].value("ends", Json::array()))
            if (end.value("opening", Json()).is_string() && end["direction_sd_deg"].is_number())
                doubts[end["opening"]] = end["direction_sd_deg"];
    }
    return doubts;
}

class Judge {
public:
    Judge(const Truth& truth, const Surface& surface, const Json& report, bool flow)
        : truth_(truth), surface_(surface), flow_(flow), distance_(surface) {
        const auto tubes = tube_lengths(report);
        const auto doubts = told_doubts(report);
        if (!flow && !tubes.empty()) fail("tubes", counted(tubes.size(), "tube") + " at ends");
        for (const PatchMeasures& patch : measure_patches(surface)) {
            if (patch.kind == PatchKind::Wall) continue;
            const auto tube = tubes.find(patch.name);
            const double length = tube == tubes.end() ? 0.0 : tube->second;
            const auto doubt = doubts.find(patch.name);
            openings_.push_back({.name = patch.name,
                                 .inlet = patch.kind == PatchKind::Inlet,
                                 .place = patch.centroid - length * patch.normal,
                                 .normal = patch.normal,
                                 .diameter = 2.0 * std::sqrt(patch.area / std::numbers::pi),
                                 .doubt = doubt == doubts.end() ? 0.0 : doubt->second});
        }
    }

    Json run() {
        check_surface();
        for (Opening& opening : openings_) find_end(opening);
        if (flow_) check_openings();
        check_lost();
        if (!flow_) check_added();
        Json told = Json::array();
        for (const Opening& opening : openings_)
            told.push_back({{"name", opening.name},
                            {"end", opening.end ? Json(*opening.end) : Json()},
                            {"optional", opening.end && truth_.ends[*opening.end].optional},
                            {"tilt_deg", opening.tilt},
                            {"told_sd_deg", opening.doubt},
                            {"cut_at_mm", opening.cut_at}});
        return {{"right", failures_.empty()},
                {"failures", failures_},
                {"openings", told},
                {"ends", truth_.ends.size()},
                {"triangles", surface_.triangle_count()}};
    }

private:
    void fail(const std::string& what, const std::string& text) {
        failures_.push_back({{"what", what}, {"text", text}});
    }

    [[nodiscard]] std::string name_of(std::size_t e) const {
        const auto& end = truth_.ends[e];
        return (end.inlet ? "the inlet, " : "") + to_string(end.kind) + " end " +
               std::to_string(e) + " of " + formatted(2.0 * end.radius) + " mm at " +
               place_text(end.place);
    }

    void check_surface() {
        const Connectivity found = connectivity(*surface_.topology);
        if (!found.closed) fail("not closed", counted(found.boundary_loops, "open border"));
        if (!found.manifold) fail("not manifold", "");
        if (found.components != 1) fail("parts", counted(found.components, "part"));
        // what touches in an image cannot be told from what is joined
        const bool distinct = truth_.kind == to_string(CaseKind::OpenSurface) ||
                              truth_.kind == to_string(CaseKind::ClosedSurface);
        if (distinct && found.genus && *found.genus != truth_.genus)
            fail("genus", "genus " + std::to_string(*found.genus) + ", truly " +
                              std::to_string(truth_.genus));
    }

    static constexpr double kBeside = 1.2;  // an opening's radii off its vessel's line
    static constexpr double kAlong = 60.0;  // degrees off its direction

    void find_end(Opening& opening) {
        double best = kBeside;
        for (std::size_t e = 0; e < truth_.ends.size(); ++e) {
            const auto& branch = truth_.branches[truth_.ends[e].branch];
            const Foot foot = foot_of(opening.place, branch.line);
            const double beside = (foot.distance - truth_.resolution) / foot.radius;
            if (beside >= best || foot.abscissa <= 0.0) continue;
            if (degrees_between(opening.normal, tangent_at(branch.line, foot.abscissa)) > kAlong)
                continue;
            best = beside;
            opening.end = e;
            opening.cut_at = foot.abscissa;
        }
        if (opening.end) opening.tilt = tilt_of(opening);
    }

    /// An opening across a vessel that only leads to ends that may be removed: it is where the
    /// vessel ends without them.
    [[nodiscard]] bool ends_all_optional(const Opening& opening) const {
        return std::ranges::any_of(truth_.branches, [&](const Truth::Branch& branch) {
            const Foot foot = foot_of(opening.place, branch.line);
            return !branch.end && (foot.distance - truth_.resolution) / foot.radius < kBeside &&
                   foot.abscissa > 0.0 &&
                   degrees_between(opening.normal, tangent_at(branch.line, foot.abscissa)) <
                       kAlong &&
                   leads_to_optional_ends(branch);
        });
    }

    /// False for a branch that closes a loop: no other one begins where it ends.
    [[nodiscard]] bool leads_to_optional_ends(const Truth::Branch& branch) const {
        constexpr double kSamePlace = 1e-6;  // mm
        if (branch.end) return truth_.ends[*branch.end].optional;
        std::size_t further = 0;
        for (const auto& next : truth_.branches) {
            if ((next.line.front().at - branch.line.back().at).norm() > kSamePlace) continue;
            if (!leads_to_optional_ends(next)) return false;
            ++further;
        }
        return further > 0;
    }

    [[nodiscard]] double tilt_of(const Opening& opening) const {
        const auto& end = truth_.ends[*opening.end];
        const Line& line = truth_.branches[end.branch].line;
        double least = 180.0;
        for (int i = -10; i <= 10; ++i) {
            const double s = opening.cut_at + kWhere * 2.0 * end.radius * i / 10.0;
            least = std::min(
                least, degrees_between(opening.normal,
                                       tangent_at(line, std::clamp(s, 0.0, length_of(line)))));
        }
        const bool at_rim = (opening.place - end.place).norm() < end.radius + truth_.resolution;
        if (!end.rim_normal.isZero() && at_rim)
            least = std::min(least, degrees_between(opening.normal, end.rim_normal));
        return least;
    }

    void check_openings() {
        std::vector<int> count(truth_.ends.size(), 0);
        int inlets = 0;
        for (const Opening& opening : openings_) {
            inlets += opening.inlet ? 1 : 0;
            if (!opening.end && ends_all_optional(opening)) continue;
            if (!opening.end) {
                fail("opening invented",
                     opening.name + " at " + place_text(opening.place) + " is at no vessel's end");
                continue;
            }
            ++count[*opening.end];
            if (opening.inlet && !truth_.ends[*opening.end].inlet)
                fail("wrong inlet", opening.name + " is at " + name_of(*opening.end));
            check_cut(opening);
        }
        if (inlets != 1) fail("inlets", counted(static_cast<std::size_t>(inlets), "inlet"));
        for (std::size_t e = 0; e < truth_.ends.size(); ++e) {
            const auto& end = truth_.ends[e];
            if (count[e] == 0 && !end.optional)
                fail(end.inlet ? "inlet closed" : "end closed", name_of(e) + " is not open");
            if (count[e] > 1) fail("opening twice", name_of(e) + " has several openings");
        }
    }

    void check_cut(const Opening& opening) {
        const auto& end = truth_.ends[*opening.end];
        const auto& branch = truth_.branches[end.branch];
        if (end.optional) return;  // it need not be there at all
        if (opening.tilt > most_tilt(truth_.resolution, 2.0 * end.radius))
            fail("cap tilted", opening.name + " by " + formatted(opening.tilt, "%.1f") +
                                   " degrees, at " + name_of(*opening.end));
        if (branch.free_length() < kLongBranch * branch.diameter()) return;
        const double whole = end.whole_to - branch.free_from;
        const double kept = opening.cut_at + truth_.resolution - branch.free_from;
        if (kept < (1.0 - kLostShare) * whole)
            fail("cut off", opening.name + " cuts " +
                                formatted(100.0 * (1.0 - kept / whole), "%.0f") + " % of " +
                                formatted(whole) + " mm off, at " + name_of(*opening.end));
    }

    /// How far a branch has to be there: to where it was cut, or where its sections are whole.
    [[nodiscard]] double present_to(const Truth::Branch& branch) const {
        if (!branch.end) return length_of(branch.line);
        double limit = truth_.ends[*branch.end].whole_to;
        for (const Opening& opening : openings_)
            if (flow_ && opening.end == branch.end) limit = std::min(limit, opening.cut_at);
        return limit;
    }

    void check_lost() {
        const double shortest = flow_ ? kLongBranch : 1.0;
        for (std::size_t b = 0; b < truth_.branches.size(); ++b) {
            const auto& branch = truth_.branches[b];
            if (!branch.resolved || branch.free_length() < shortest * branch.diameter()) continue;
            const double lost = lost_share(branch);
            if (lost <= kLostShare) continue;
            fail("branch lost",
                 formatted(100.0 * lost, "%.0f") + " % of " + formatted(branch.free_length()) +
                     " mm of branch " + std::to_string(b) + ", " + formatted(branch.diameter()) +
                     " mm thick, at " +
                     place_text(at_abscissa(branch.line, 0.5 * length_of(branch.line)).at));
        }
    }

    [[nodiscard]] double lost_share(const Truth::Branch& branch) const {
        constexpr int kSamples = 60;
        const double to = present_to(branch);
        int lost = 0;
        for (int i = 0; i < kSamples; ++i) {
            const double s = branch.free_from + (to - branch.free_from) * (i + 0.5) / kSamples;
            const LinePoint p = at_abscissa(branch.line, s);
            const double beside = kBesideShare * p.radius + 0.5 * truth_.resolution;
            lost += distance_.signed_distance(p.at) > beside ? 1 : 0;
        }
        return static_cast<double>(lost) / kSamples;
    }

    /// Tubes at a print's ends, or anything else outside the vessels.
    void check_added() {
        constexpr double kOutside = 0.5;  // radii
        constexpr std::size_t kEvery = 5;
        double most = 0.0;
        Vec3 where = Vec3::Zero();
        const Positions& points = surface_.points();
        for (std::size_t v = 0; v < points.size(); v += kEvery) {
            const double out = outside(points[v], kOutside);
            if (out > most) most = out, where = points[v];
        }
        if (most > 2.0 * truth_.resolution)
            fail("added", "something " + formatted(most) + " mm outside the vessels at " +
                              place_text(where));
    }

    /// Distance of p beyond the vessels, thickened by `share` of their radii [mm].
    [[nodiscard]] double outside(const Vec3& p, double share) const {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& branch : truth_.branches) {
            const Foot foot = foot_of(p, branch.line);
            least = std::min(least, foot.distance - (1.0 + share) * foot.radius);
        }
        for (const Sac& sac : truth_.sacs)
            least = std::min(least, (p - sac.centre).norm() - (1.0 + share) * sac.radius);
        return least;
    }

    const Truth& truth_;
    const Surface& surface_;
    bool flow_;
    SurfaceDistance distance_;
    std::vector<Opening> openings_;
    Json failures_ = Json::array();
};

}  // namespace

Json judge(const Truth& truth, const std::filesystem::path& result, bool flow) {
    const Json report = Json::parse(file_content(result / "report.json"));
    const SurfaceFile file =
        read_surface((result / "surface.vtp").string(), LengthUnit::Millimetre);
    return Judge(truth, file.surface, report, flow).run();
}

}  // namespace vesselbench::forest
