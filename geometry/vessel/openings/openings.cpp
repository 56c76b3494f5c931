#include "geometry/vessel/openings/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/cut_trial.h"
#include "geometry/vessel/openings/frayed_trunks.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/surface_ends.h"
#include "geometry/vessel/openings/unlined_ends.h"

namespace vesselbench {

namespace {

/// A cap at an image's border, and any cap if ends are cut strictly, is kept if it is perpendicular
/// to its vessel within this angle [deg] and, if strict, flat to this fraction of its diameter.
constexpr double kKeptTiltDeg = 3.0;
constexpr double kStrictTiltDeg = 2.0;
constexpr double kStrictFlatness = 1e-5;
/// Least rise of the wall at a flat rim where a centerline ends [deg]; elsewhere kLeastRiseDeg.
constexpr double kLeastRiseAtTip = 30.0;
/// A rim or cap this wide beside the widest other end is an end, whatever it looks like [-].
constexpr double kAsWide = 0.8;
/// A rim is cut off along its own plane if it is no farther from it than this [diameters].
constexpr double kMostTorn = 0.5;
/// That cut lies behind the rim's deepest notch by this much [diameters].
constexpr double kBehindRim = 0.02;
/// If a larger fraction of a branch is given up, a warning says so.
constexpr double kNoticedShare = 0.1;
/// A larger tilt of an opening is mentioned [deg].
constexpr double kNoticedTiltDeg = 2.0;
/// So is a larger standard deviation of the direction that it was given [deg].
constexpr double kNoticedDoubtDeg = 2.0;
/// A point this far from a tip does not mean it [radii of the tip].
constexpr double kFarthestTip = 4.0;
/// A shorter branch may be a bump of the wall [radii].
constexpr double kLeastProtrusion = 1.0 / 3.0;

std::string degrees_text(double angle) {
    return formatted(angle, "%.0f degrees");
}

OpeningPlace place_on(const Plane& plane, double diameter, const Vec3& tip,
                      const std::optional<OpeningAxis>& axis) {
    return {.tip = tip,
            .plane = plane,
            .diameter = diameter,
            .tilt_deg = axis ? axis->tilt_deg : 0.0,
            .bend_deg = axis ? axis->bend_deg : 0.0,
            .measured = axis.has_value()};
}

class Planner {
public:
    /// \param frayed tips of the graph
    Planner(const Surface& surface, const CenterlineGraph& graph,
            const std::vector<FrayedTrunk>& frayed, const OpeningPlanOptions& options,
            const Progress& progress)
        : surface_(surface),
          graph_(graph),
          frayed_(frayed),
          options_(options),
          progress_(progress),
          ends_(find_surface_ends(surface, graph)),
          made_(ends_.size()),
          records_(ends_.size()),
          decided_(ends_.size(), false),
          trials_(surface, graph, ends_) {
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            progress_.check_cancelled();
            records_[e] = record_of(ends_[e]);
            in_side_.push_back(lies_in_side(e));
        }
        if (options.tip) return;
        for (const UnlinedEnd& end : unlined_ends(surface, graph, options.stubs, ends_)) {
            unlined_.push_back(record_of(end));
            unlined_.back().asked = options.leave_closed;
        }
    }

    OpeningPlan run() {
        if (ends_.empty())
            throw AlgorithmFailure(
                "no vessel end that could be opened was found: give one with tip=x,y,z");
        if (options_.tip)
            plan_one(end_of_tip(tip_to_open(graph_, *options_.tip)));
        else
            plan_all();
        return finished();
    }

private:
    /// A torn rim is longer than it is wide; a hole in a vessel's side is narrower than the vessel.
    EndRecord record_of(const SurfaceEnd& end) const {
        if (end.rim.empty())
            return {.place = end.centre,
                    .diameter = end.diameter,
                    .border = options_.border_cuts && end.patch &&
                              surface_.patches[*end.patch].kind == PatchKind::Cut};
        const double width = rim_shape(surface_, end.rim).diameter();
        return {.place = end.centre,
                .diameter = end.tip ? std::min(end.diameter, width) : width,
                .rim = true};
    }

    static EndRecord record_of(const UnlinedEnd& end) {
        return {.place = end.place,
                .diameter = end.diameter,
                .why = std::string(end.sac ? "it looks like an aneurysm, and is" : "it is") +
                       " too short for a centerline, " + formatted(end.length) +
                       " mm beyond the vessels around; open=" + coordinates_argument(end.place) +
                       " opens it",
                .sac = end.sac,
                .offered = true,
                .unlined = true};
    }

    /// The end without a line that a point means: it is near, and nearer than all others.
    EndRecord* unlined_near(const Vec3& point) {
        const auto end = end_near(ends_, point);
        double least =
            end ? (ends_[*end].centre - point).norm() : std::numeric_limits<double>::infinity();
        EndRecord* found = nullptr;
        for (EndRecord& record : unlined_)
            if (const double d = (record.place - point).norm();
                d < least && d <= kUnlinedReach * record.diameter) {
                least = d;
                found = &record;
            }
        return found;
    }

    std::size_t end_of_tip(std::size_t tip) const {
        for (std::size_t e = 0; e < ends_.size(); ++e)
            if (ends_[e].tip && *ends_[e].tip == tip) return e;
        return 0;
    }

    /// A rim, or an image's border, where no vessel ends: the vessel passes it. A cap that has a
    /// name was meant by whoever gave it, as was a surface's own rim or cap that is as wide as the
    /// widest other end: a trunk cut close to its furcation looks as if the vessel passed.
    bool lies_in_side(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        if (end.patch ? surface_.patches[*end.patch].kind != PatchKind::Cut : end.rim.empty())
            return false;
        const auto rim = end.patch ? rim_shape_of_cap(surface_, *end.patch)
                                   : std::optional(rim_shape(surface_, end.rim));
        if (!rim || !rim->is_graze()) return false;
        if (!options_.border_cuts && rim->diameter() > kAsWide * widest_beside(e)) return false;
        if (!end.tip) return true;
        const auto blind = blind_branch(graph_, *end.tip);
        return blind && blind->length < kLeastOwnVessel * rim->diameter();
    }

    /// Diameter of the widest other end [mm]; 0: there is none.
    double widest_beside(std::size_t e) const {
        double widest = 0.0;
        for (std::size_t other = 0; other < ends_.size(); ++other)
            if (other != e) widest = std::max(widest, ends_[other].diameter);
        return widest;
    }

    void plan_one(std::size_t end) {
        for (std::size_t e = 0; e < ends_.size(); ++e) decided_[e] = e != end;
        if (!keep(end) && !cut(end)) throw AlgorithmFailure(records_[end].why);
        records_ = {records_[end]};
        made_ = {made_[end]};
    }

    void plan_all() {
        name_inlets();
        for (const Vec3& point : options_.open) wanted_.push_back(end_meant(point, "open"));
        leave_closed();
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            report_decided();
            if (!decided_[e] && ends_[e].is_visible()) static_cast<void>(keep(e));
        }
        const bool blind_too = opens_blind_ends();
        std::vector<std::size_t> order(ends_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, std::greater{},
                                 [&](std::size_t e) { return ends_[e].diameter; });
        const std::vector<std::string> doubts = doubts_about_ends();
        const auto rank = [&](std::size_t e) {
            return ends_[e].is_visible() ? 0 : doubts[e].empty() ? 1 : 2;
        };
        for (const int turn : {0, 1, 2})
            for (const std::size_t e : order) {
                report_decided();
                if (!decided_[e] && rank(e) == turn)
                    plan_end(e, blind_too || is_wanted(e), doubts[e]);
            }
        for (std::size_t e = 0; e < ends_.size(); ++e)
            if (is_wanted(e) && !made_[e])
                throw AlgorithmFailure(std::string("the ") + (is_inlet(e) ? "inlet" : "end") +
                                       " at " + place_text(ends_[e].centre) +
                                       " cannot be opened: " + records_[e].why);
    }

    /// \throw Cancelled if the user cancels
    void report_decided() const {
        const auto decided = static_cast<double>(std::ranges::count(decided_, true));
        progress_.report(decided / static_cast<double>(decided_.size()), "deciding about the ends");
    }

    void name_inlets() {
        for (const Vec3& point : options_.inlets) {
            const std::size_t end = end_meant(point, "inlet");
            if (is_inlet(end))
                throw AlgorithmFailure("two inlets mean the same end, at " +
                                       place_text(ends_[end].centre));
            inlets_.push_back(end);
        }
    }

    std::size_t end_meant(const Vec3& point, const std::string& parameter) const {
        if (const auto end = end_near(ends_, point)) return *end;
        const auto nearest = std::ranges::min_element(
            ends_, {}, [&](const SurfaceEnd& e) { return (e.centre - point).norm(); });
        throw AlgorithmFailure("no vessel ends near " + parameter + "=" +
                               coordinates_argument(point) + "; the nearest end is at " +
                               place_text(nearest->centre));
    }

    bool is_inlet(std::size_t e) const { return std::ranges::count(inlets_, e) > 0; }

    /// Named by the caller: it has to be opened.
    bool is_wanted(std::size_t e) const {
        return is_inlet(e) || std::ranges::count(wanted_, e) > 0;
    }

    /// A side at an image's border is no end; a rim of a surface may be one if the caller says so.
    bool stays_side(std::size_t e) const {
        return in_side_[e] && (options_.border_cuts || !is_wanted(e));
    }

    void leave_closed() {
        for (const Vec3& point : options_.closed) {
            if (EndRecord* unlined = unlined_near(point)) {
                unlined->asked = true;
                unlined->why = "left closed as asked";
                continue;
            }
            const auto end = end_near(ends_, point);
            if (!end)
                throw AlgorithmFailure("no vessel ends near closed=" + coordinates_argument(point));
            records_[*end].asked = true;
            close(*end, "left closed as asked");
        }
    }

    /// Open rims and named caps determine the vessel ends. Cuts at an image's border do not: other
    /// vessels may end inside the image. Nor does a single end: blood has to enter and leave.
    bool opens_blind_ends() const {
        const auto determines = [&](const SurfaceEnd& end) {
            const auto e = static_cast<std::size_t>(&end - ends_.data());
            return (!end.rim.empty() && !in_side_[e]) ||
                   (end.patch && surface_.patches[*end.patch].kind != PatchKind::Cut);
        };
        const auto is_end = [&](const SurfaceEnd& end) {
            const auto e = static_cast<std::size_t>(&end - ends_.data());
            return end.is_visible() && !in_side_[e] && (end.tip || made_[e]);
        };
        return std::ranges::none_of(ends_, determines) || std::ranges::count_if(ends_, is_end) < 2;
    }

    /// By end, why it may be none though a centerline ends there; empty: there is no doubt.
    std::vector<std::string> doubts_about_ends() const {
        std::vector<std::string> doubts(ends_.size());
        if (options_.strict) return doubts;
        const auto facing = facing_ends(ends_, graph_);
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            if (ends_[e].is_visible() || is_wanted(e) || frays(e)) continue;
            if (facing[e]) {
                doubts[e] = "the vessel is broken there: it faces the end at " +
                            place_text(ends_[*facing[e]].centre);
                continue;
            }
            const auto blind = blind_branch(graph_, *ends_[e].tip);
            if (blind && blind->length < kLeastProtrusion * blind->widest) {
                doubts[e] = "it protrudes by " + formatted(blind->length) +
                            " mm only from the vessels around";
                continue;
            }
            if (!options_.voxels) continue;
            const VoxelWidth width = width_at_tip(graph_, *ends_[e].tip, *options_.voxels);
            if (width.is_fading())
                doubts[e] = "it fades from the image there: " + formatted(width.diameter) +
                            " mm wide, between voxels " + formatted(width.voxels) + " mm apart";
        }
        return doubts;
    }

    /// Two others are open, and one of them is wider: the flow does not need the end.
    bool is_spare(std::size_t e) const {
        const auto open = std::ranges::count_if(made_, [](const auto& m) { return m.has_value(); });
        double widest = 0.0;
        for (std::size_t other = 0; other < ends_.size(); ++other)
            if (made_[other]) widest = std::max(widest, ends_[other].diameter);
        return open >= 2 && widest >= ends_[e].diameter;
    }

    /// \param doubt why the end may be none; may be empty
    void plan_end(std::size_t e, bool blind_too, const std::string& doubt) {
        const SurfaceEnd& end = ends_[e];
        if (stays_side(e) && !options_.strict)
            return close(e, "it lies in the side of a vessel that passes there");
        if (!end.is_visible() && options_.leave_closed && !is_wanted(e)) {
            records_[e].asked = true;
            return close_offering(e, "closed ends are left as they are");
        }
        if (!end.is_visible() && !blind_too && !is_wider_than_all(e)) {
            const auto blind = blind_branch(graph_, *end.tip);
            records_[e].sac = blind && blind->is_sac();
            return close_offering(e, "a closed end: the surface's own rims are its openings");
        }
        if (!end.is_visible() && !is_wanted(e) && !frays(e) && looks_closed(e)) return;
        if (!doubt.empty() && is_spare(e)) return close_offering(e, doubt);
        if (cut(e)) return;
        if (options_.strict)
            throw AlgorithmFailure(
                "the end at " + place_text(end.centre) + " cannot be cut: " + records_[e].why +
                "; closed=" + coordinates_argument(end.centre) + " leaves it closed on purpose");
        if (!is_fixed() && is_stub(e)) return remove(e);
        records_[e].tried = true;
        close(e, records_[e].why);
    }

    /// A blind branch beside open rims is an end after all if it is the widest one and no sac:
    /// long, or a trunk.
    bool is_wider_than_all(std::size_t e) const {
        for (std::size_t other = 0; other < ends_.size(); ++other)
            if (ends_[other].is_visible() && made_[other] &&
                ends_[other].diameter >= ends_[e].diameter)
                return false;
        const auto blind = blind_branch(graph_, *ends_[e].tip);
        return !options_.strict && blind && !blind->bulges &&
               (frays(e) || !blind->is_short() || is_trunk(e, *blind));
    }

    /// As long as it is wide, and wider than every visible end: it is where the blood enters, and
    /// the image, or its mask, ends there. Its tip is rounded, so its width is the branch's.
    bool is_trunk(std::size_t e, const BlindBranch& blind) const {
        const double width = std::max(ends_[e].diameter, 2.0 * blind.widest);
        const bool widest = std::ranges::none_of(ends_, [&](const SurfaceEnd& other) {
            return other.is_visible() && kAsLarge * other.diameter >= width;
        });
        return widest && blind.length >= 2.0 * blind.widest;
    }

    /// True if a blind branch too long for a sac or a knob is among the ends.
    bool has_rounded_end() const {
        return std::ranges::any_of(ends_, [&](const SurfaceEnd& end) {
            if (end.is_visible() || !end.tip) return false;
            const auto blind = blind_branch(graph_, *end.tip);
            return blind && !blind->is_short() && !blind->bulges;
        });
    }

    /// An aneurysm stays closed, as does a branch too short to be opened. If an image's border
    /// already provides inflow and outflow, a short blind stub is not an opening either; if flat
    /// caps do, and are all of the vessel's other ends, a knob is none.
    bool looks_closed(std::size_t e) {
        const auto blind = blind_branch(graph_, *ends_[e].tip);
        if (!blind || !blind->is_short()) return false;
        const bool sac = blind->bulges || is_ball(surface_, graph_, *ends_[e].tip);
        const auto visible = std::ranges::count_if(ends_, &SurfaceEnd::is_visible);
        const bool needless =
            visible >= 2 && (options_.border_cuts || (blind->is_knob() && !has_rounded_end()));
        if (!sac && (!needless || is_trunk(e, *blind))) return false;
        records_[e].sac = sac && (!blind->bulges || blind->is_sac());
        close_offering(e, sac ? "it looks like an aneurysm" : "its branch is short");
        return true;
    }

    /// The reason says how to open it nevertheless.
    void close_offering(std::size_t e, const std::string& why) {
        records_[e].offered = true;
        close(e, why + "; open=" + coordinates_argument(ends_[e].centre) + " opens it");
    }

    bool is_stub(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        if (!end.tip || end.patch || has_failed(e, graph_.nodes[*end.tip].position)) return false;
        const auto blind = blind_branch(graph_, *end.tip);
        return blind && blind->is_stub() && blind->length < kMostGivenUp * end.diameter;
    }

    /// The place of the cuts was given.
    bool is_fixed() const { return options_.distance || options_.radii; }

    std::optional<double> distance(std::size_t tip) const {
        if (options_.distance) return options_.distance;
        if (options_.radii) return *options_.radii * tip_radius(graph_, tip);
        return std::nullopt;
    }

    bool has_failed(std::size_t e, const Vec3& place) const {
        return failure_at(e, place) != nullptr;
    }

    const FailedCut* failure_at(std::size_t e, const Vec3& place) const {
        const double same = 1e-6 * (1.0 + ends_[e].diameter);
        const Vec3 tip = tip_place(ends_[e]);
        const auto found = std::ranges::find_if(options_.failed, [&](const FailedCut& failed) {
            const double beyond = (place - tip).norm() - (failed.place - tip).norm();
            return (failed.place - place).norm() < same ||
                   (failed.lost && (failed.tip - tip).norm() < same && beyond > -same);
        });
        return found == options_.failed.end() ? nullptr : &*found;
    }

    // --- keeping ---------------------------------------------------------------------------------

    /// Keeps a good cap or rim as it is.
    bool keep(std::size_t e) {
        if (is_fixed() || stays_side(e)) return false;
        const auto place = ends_[e].patch ? kept_cap(e) : kept_rim(e);
        if (!place || has_failed(e, place->plane.point)) return false;
        const bool cap = ends_[e].patch.has_value();
        std::string why = cap ? "its flat cap was kept" : "its flat rim was capped as it is";
        if (place->measured && place->tilt_deg > kNoticedTiltDeg)
            why += ", tilted by " + degrees_text(place->tilt_deg) + " against the vessel's axis";
        make(e, *place, cap ? OpeningWay::KeepCap : OpeningWay::CapRim, EndFate::Kept, why);
        records_[e].plain = true;
        trials_.protect(ends_[e]);
        return true;
    }

    /// Why a rim or cap is not kept; empty if there is none.
    std::string end_problem(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        if (is_fixed() || !end.is_visible()) return "";
        if (end.patch) {
            const PatchShape shape = patch_shape(surface_, *end.patch);
            return is_flat(shape) ? "its cap is not perpendicular to the vessel"
                                  : "its cap is " + formatted(shape.flatness) + " mm off its plane";
        }
        const RimShape rim = rim_shape(surface_, end.rim);
        if (rim.rise_deg <= (end.tip ? kLeastRiseAtTip : kLeastRiseDeg))
            return "its wall rises by " + degrees_text(rim.rise_deg) + " only from the rim's plane";
        return "its rim is " + formatted(rim.flatness) + " mm off its plane";
    }

    Vec3 tip_place(const SurfaceEnd& end) const {
        return end.tip ? graph_.nodes[*end.tip].position : end.centre;
    }

    /// The threads in which an end frays; null: it does not.
    const FrayedTrunk* frays(std::size_t e) const {
        const auto& tip = ends_[e].tip;
        const auto found = std::ranges::find_if(
            frayed_, [&](const FrayedTrunk& trunk) { return tip && trunk.tip == *tip; });
        return found == frayed_.end() ? nullptr : &*found;
    }

    std::string fray_text(std::size_t e) const {
        double widest = 0.0;
        for (const ThinEnd& thread : frays(e)->ends) widest = std::max(widest, thread.diameter);
        return "the vessel frays there into " + std::to_string(frays(e)->ends.size()) +
               " threads of at most " + formatted(widest) + " mm, which were cut off";
    }

    /// False for the plate that an image's border leaves where it grazes a bulge.
    bool rises(std::size_t patch) const {
        const auto rim = rim_shape_of_cap(surface_, patch);
        return !rim || rim->rise_deg > kLeastRiseAtTip;
    }

    std::optional<OpeningPlace> kept_cap(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        const PatchShape shape = patch_shape(surface_, *end.patch);
        const auto axis = axis_at_patch(surface_, *end.patch);
        const double tilt = axis ? axis->tilt_deg : 90.0;
        const bool meant =
            !options_.border_cuts || surface_.patches[*end.patch].kind != PatchKind::Cut;
        const bool good =
            options_.strict
                ? end.tip && shape.flatness <= kStrictFlatness * shape.diameter() &&
                      tilt <= kStrictTiltDeg
                : is_flat(shape) && (meant || (tilt <= kKeptTiltDeg && rises(*end.patch)));
        if (!good) return std::nullopt;
        return place_on(shape.plane, shape.diameter(), tip_place(end), axis);
    }

    std::optional<OpeningPlace> kept_rim(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        if (end.rim.empty() || options_.strict) return std::nullopt;
        RimShape rim = rim_shape(surface_, end.rim);
        // A centerline ends there: the rim may lie in a wide mouth, such as a heart valve's.
        if (end.tip && rim.rise_deg > kLeastRiseAtTip)
            rim.rise_deg = std::max(rim.rise_deg, kLeastRiseDeg + 1.0);
        if (!rim.is_good()) return std::nullopt;
        const double diameter = rim.diameter();
        const auto axis =
            axis_inward(part_near(surface_, rim.plane.point, 2.5 * diameter), rim.plane, diameter);
        return place_on(rim.plane, diameter, tip_place(end), axis);
    }

    // --- cutting ---------------------------------------------------------------------------------

    /// Cuts an end across its vessel; else along its own rim, unless it is a stub that can go.
    /// False: there is no place for a cut, and the record says why.
    bool cut(std::size_t e) {
        if (cut_across(e)) return true;
        if (options_.strict || is_fixed() || (is_stub(e) && !is_large_rim(e))) return false;
        const std::string why = records_[e].why;
        const auto place = place_along_rim(e);
        if (place && is_free(*place, e)) return make_cut(e, *place, "cut along its rim: " + why);
        records_[e].why = why;
        return keep_oblique(e);
    }

    /// The last resort at an image's border: a vessel ends there, even if its furcation is so near
    /// that no place for a cut across it is left.
    bool keep_oblique(std::size_t e) {
        const SurfaceEnd& end = ends_[e];
        if (!records_[e].border || !end.tip || !rises(*end.patch) || !trials_.is_whole_cap(end))
            return false;
        const PatchShape shape = patch_shape(surface_, *end.patch);
        const auto axis = axis_at_patch(surface_, *end.patch);
        const OpeningPlace place = place_on(shape.plane, shape.diameter(), tip_place(end), axis);
        if (!is_flat(shape) || has_failed(e, place.plane.point)) return false;
        make(e, place, OpeningWay::KeepCap, EndFate::Kept,
             "its cap at the image's border was kept, though it is not perpendicular to the "
             "vessel: " +
                 records_[e].why);
        trials_.protect(end);
        return true;
    }

    /// True for a rim that may not vanish (kLargeEnd).
    bool is_large_rim(std::size_t e) const {
        return !ends_[e].rim.empty() &&
               rim_shape(surface_, ends_[e].rim).diameter() > kLargeEnd * widest_beside(e);
    }

    /// Just behind an open rim, in the direction of its own plane. Empty: the end has none, or one
    /// that is hardly a vessel's end.
    std::optional<OpeningPlace> place_along_rim(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        if (end.rim.empty()) return std::nullopt;
        const RimShape rim = rim_shape(surface_, end.rim);
        if (rim.rise_deg <= kLeastRiseDeg || rim.flatness > kMostTorn * rim.diameter())
            return std::nullopt;
        double depth = 0.0;
        for (const VertexId v : end.rim)
            depth = std::max(depth, -rim.plane.distance(surface_.points()[v]));
        depth += kBehindRim * rim.diameter();
        Plane plane{rim.plane.point - depth * rim.plane.normal, rim.plane.normal};
        const auto section = cross_section_at(surface_, plane);
        if (!section || !section->closed) return std::nullopt;
        plane.point = section->centroid;
        OpeningPlace place =
            place_on(plane, section->diameter(), tip_place(end),
                     axis_inward(part_near(surface_, plane.point, 2.5 * rim.diameter()), plane,
                                 rim.diameter()));
        place.distance = depth;
        return place;
    }

    /// Cuts an end at the chosen place, else at the nearest one that can be cut. False: there is
    /// none, and the record says why.
    bool cut_across(std::size_t e) {
        const SurfaceEnd& end = ends_[e];
        EndRecord& record = records_[e];
        if (!end.tip) {
            record.why = end.patch ? "its cap is not flat, and no vessel's tip is there"
                                   : "its rim is not flat, and no vessel's tip is there";
            return false;
        }
        try {
            const OpeningPlace place =
                choose_opening_place(surface_, graph_, *end.tip, distance(*end.tip));
            if (is_free(place, e))
                return make_cut(e, place, frays(e) ? fray_text(e) : end_problem(e), !frays(e));
        } catch (const AlgorithmFailure& failure) {
            record.why = failure.what();
        }
        if (options_.strict || is_fixed()) return false;
        const auto free = [&](const OpeningPlace& place) { return is_free(place, e); };
        const auto near = [&](const OpeningPlace& place) {
            return place.distance < kMostGivenUp * place.diameter && free(place);
        };
        const std::string why = record.why;
        if (const auto place = nearest_opening_place(surface_, graph_, *end.tip, near))
            return make_cut(e, *place, "cut at the nearest place that can be: " + why);
        const auto blind = blind_branch(graph_, *end.tip);
        if (blind && blind->length < kLongestAcross * end.diameter)
            if (const auto place = place_across_furcation(surface_, graph_, *end.tip, free))
                return make_cut(e, *place, "cut across its furcation: " + why);
        record.why = why;
        return false;
    }

    bool is_free(const OpeningPlace& place, std::size_t e) {
        progress_.check_cancelled();
        if (const FailedCut* failed = failure_at(e, place.plane.point)) {
            records_[e].why = failed->why;
            return false;
        }
        if (options_.tip && is_fixed()) return true;  // as the user says
        const std::string problem = trials_.problem_of(place, e);
        if (problem.empty()) return true;
        records_[e].why = "the branch with its tip at " + place_text(place.tip) + ": " + problem;
        return false;
    }

    bool make_cut(std::size_t e, const OpeningPlace& place, const std::string& why,
                  bool chosen = false) {
        make(e, place, OpeningWay::Cut, EndFate::Opened, why);
        records_[e].plain = chosen;
        if (options_.tip && is_fixed()) return true;
        for (const std::size_t other : trials_.taken_along())
            if (!decided_[other]) {
                records_[other].fate = EndFate::Removed;
                records_[other].shared = true;
                records_[other].why =
                    "part of the end at " + place_text(ends_[e].centre) + ", which was cut off";
                decided_[other] = true;
            }
        trials_.take();
        return true;
    }

    void make(std::size_t e, const OpeningPlace& place, OpeningWay way, EndFate fate,
              const std::string& why) {
        PlannedOpening opening{.place = place, .way = way, .patch = std::nullopt};
        const auto& patch = ends_[e].patch;
        if (patch && surface_.patches[*patch].kind != PatchKind::Cut)
            opening.patch = surface_.patches[*patch];
        made_[e] = opening;
        decided_[e] = true;
        records_[e].fate = fate;
        records_[e].why = why;
        if (way == OpeningWay::Cut) warn_of_place(opening);
    }

    void close(std::size_t e, const std::string& why) {
        decided_[e] = true;
        records_[e].fate = EndFate::Closed;
        records_[e].why = why;
        const SurfaceEnd& end = ends_[e];
        if (end.is_visible())
            plan_.closings.push_back(
                {end.centre, end.patch ? ClosingWay::WallCap : ClosingWay::FillRim});
    }

    void remove(std::size_t e) {
        decided_[e] = true;
        records_[e].fate = EndFate::Removed;
        records_[e].why = "a stub shorter than its parent is wide: " + records_[e].why;
        plan_.closings.push_back({graph_.nodes[*ends_[e].tip].position, ClosingWay::RemoveStub});
    }

    void warn_of_place(const PlannedOpening& opening) {
        const OpeningPlace& place = opening.place;
        const std::string at = place_text(place.plane.point);
        if (place.bend_deg > kBendDeg)
            plan_.warnings.push_back("the opening at " + at +
                                     " lies in a bend: the vessel turns by " +
                                     degrees_text(place.bend_deg) + " over one diameter");
        if (place.share > kNoticedShare)
            plan_.warnings.push_back("the opening at " + at + " gives up " +
                                     std::to_string(std::lround(100.0 * place.share)) +
                                     " % of its branch: the end is oblique or ragged");
        if (!place.measured)
            plan_.warnings.push_back("the vessel behind the opening at " + at +
                                     " is too short to measure its axis: the opening follows the "
                                     "centerline's direction");
        else if (place.doubt_deg > kNoticedDoubtDeg)
            plan_.warnings.push_back("the direction of the opening at " + at + " is known to " +
                                     degrees_text(place.doubt_deg) +
                                     " only (one standard deviation): its vessel is short, uneven "
                                     "or few voxels wide");
        if (place.tilt_deg > kNoticedTiltDeg)
            plan_.warnings.push_back("the opening at " + at + " is tilted by " +
                                     degrees_text(place.tilt_deg) + " against the vessel's axis");
    }

    OpeningPlan finished() {
        for (std::size_t e = 0; e < made_.size(); ++e) {
            if (!made_[e]) continue;
            records_[e].opening = plan_.openings.size();
            if (is_inlet(e)) plan_.inlets.push_back(plan_.openings.size());
            plan_.openings.push_back(*made_[e]);
        }
        plan_.ends = records_;
        add_threads();
        plan_.ends.insert(plan_.ends.end(), unlined_.begin(), unlined_.end());
        const auto rank = [](const EndRecord& end) {
            return std::tuple(end.plain, end.fate, -end.diameter);
        };
        std::ranges::stable_sort(plan_.ends, {}, rank);
        return std::move(plan_);
    }

    /// The report has every end found.
    void add_threads() {
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            if (!frays(e)) continue;
            for (const ThinEnd& thread : frays(e)->ends)
                plan_.ends.push_back(
                    {.place = thread.place,
                     .diameter = thread.diameter,
                     .fate = made_[e] ? EndFate::Removed : EndFate::Closed,
                     .why = "a thread of the vessel that frays at " + place_text(ends_[e].centre),
                     .shared = true,
                     .plain = true});
        }
    }

    /// An end's own vessel, beyond the others, is at least this long [diameters of the end].
    static constexpr double kLeastOwnVessel = 0.1;

    /// A cut farther from its tip [diameters], or the removal of a longer stub, would lose a vessel
    /// (lost_vessels).
    static constexpr double kMostGivenUp = 2.8;

    /// A point this far from an end without a centerline does not mean it [diameters].
    static constexpr double kUnlinedReach = 1.5;

    /// A branch that is longer than this [diameters] is cut on its own side of the furcation only.
    static constexpr double kLongestAcross = 3.0;

    const Surface& surface_;
    const CenterlineGraph& graph_;
    const std::vector<FrayedTrunk>& frayed_;
    OpeningPlanOptions options_;
    const Progress& progress_;
    std::vector<SurfaceEnd> ends_;
    std::vector<std::optional<PlannedOpening>> made_;  ///< by end
    std::vector<EndRecord> records_;                   ///< by end
    std::vector<bool> decided_;                        ///< by end
    std::vector<bool> in_side_;                        ///< by end: no vessel ends there
    std::vector<EndRecord> unlined_;                   ///< of ends without a centerline
    CutTrials trials_;
    std::vector<std::size_t> inlets_;  ///< ends that were named
    std::vector<std::size_t> wanted_;  ///< ends that shall be opened
    OpeningPlan plan_;
};

}  // namespace

std::string to_string(EndFate fate) {
    switch (fate) {
        case EndFate::Closed:
            return "closed";
        case EndFate::Removed:
            return "removed";
        case EndFate::Opened:
            return "opened";
        case EndFate::Kept:
            return "kept";
    }
    return "";
}

std::size_t tip_to_open(const CenterlineGraph& graph, const Vec3& point) {
    const auto tip = nearest_tip(graph, point);
    if (!tip) throw AlgorithmFailure("the vessels have no tip that could be opened");
    const Vec3& found = graph.nodes[*tip].position;
    if ((found - point).norm() > kFarthestTip * tip_radius(graph, *tip))
        throw AlgorithmFailure("no branch has its tip near " + place_text(point) +
                               "; the nearest one is at " + place_text(found));
    return *tip;
}

OpeningPlan plan_openings(const Surface& surface, const CenterlineGraph& graph,
                          const OpeningPlanOptions& options, const Progress& progress) {
    if (options.tip) return Planner(surface, graph, {}, options, progress).run();
    const LinesWithoutFrays lines = without_frays(surface, graph);
    return Planner(surface, lines.graph, lines.trunks, options, progress).run();
}

}  // namespace vesselbench
