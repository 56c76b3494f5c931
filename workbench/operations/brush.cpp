#include "smoothing/brush/brush.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "meshing/remeshing/local_remesh.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/stated_change.h"
#include "workbench/operations/brush/dabs.h"
#include "workbench/operations/shared/crossing_warning.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// A negative strength deflates and removes weight; there is no negative smoothing.
constexpr double kWeakest = -1.0, kSmoothWeakest = 0.0;

constexpr double kFewestEdges = 2.0;  ///< to a brush's radius

/// Growth in volume of a surface whose boundary, if any, is unchanged [mm^3].
double volume_change(const Surface& before, const Surface& after) {
    const Vec3 origin = before.points().front();
    const auto six_fold = [&](const Positions& x, const Triangle& t) {
        return (x[t[0]] - origin).dot((x[t[1]] - origin).cross(x[t[2]] - origin));
    };
    double sum = 0.0;
    for (const Triangle& t : before.triangles())
        sum += six_fold(after.points(), t) - six_fold(before.points(), t);
    return sum / 6.0;
}

/// What the dabs painted.
ordered_json painting(const Surface& before, const Surface& surface, const std::string& name) {
    const auto& after = *surface.attributes.at(name);
    const auto known = before.attributes.find(name);
    const auto old = [&](std::size_t v) {
        return known == before.attributes.end() ? 0.0 : (*known->second)[v];
    };
    std::size_t changed = 0, above = 0;
    double largest = 0.0;
    for (std::size_t v = 0; v < after.size(); ++v) {
        changed += after[v] != old(v) ? 1 : 0;
        above += after[v] > 0.0 ? 1 : 0;
        largest = std::max(largest, std::abs(after[v] - old(v)));
    }
    return {{"attribute", name},
            {"vertices_changed", changed},
            {"largest_change", largest},
            {"vertices_above_0", above}};
}

/// Letters, digits and underscores: a name that every file format accepts.
void check_attribute(const std::string& name) {
    const bool fits = name.size() > 1 && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                      std::ranges::all_of(name, [](unsigned char c) {
                          return (std::isalnum(c) != 0 && c < 128) || c == '_';
                      });
    if (!fits)
        throw UsageError("brush-weight: attribute = '" + name +
                         "' is not allowed: use two or more letters, digits and underscores, not "
                         "starting with a digit");
}

/// A stroke that dabs are added to. The walls that it would push through each other are kept apart
/// at its end, by outcome(): scene() is the stroke as it is brushed.
class LiveBrush final : public Stepper {
public:
    LiveBrush(std::string operation, const BrushSettings& settings, const Scene& scene,
              const Arguments& arguments)
        : operation_(std::move(operation)),
          settings_(settings),
          before_(scene),
          places_(std::make_shared<const SurfaceDistance>(distance_to(surface_of(scene)))),
          stroke_(std::make_unique<Stroke>(
              Stroke{.brush = {surface_of(scene), settings, places_}, .resolved = arguments})) {}

    void add(const Arguments& more, Progress& progress) override {
        for (const auto& [name, value] : more.values())
            if (!is_dab_argument(name))
                throw UsageError(operation_ + ": " + name +
                                 " stays through a stroke; start another one");
        check_continued(more);
        Outcome read;
        read.resolved = more;
        const auto dabs = resolved_dabs(operation_, surface_of(before_), *places_, read);
        if (dabs.size() == 1)
            brush(*stroke_, dabs, progress);  // leaves the stroke unchanged if it throws
        else {
            auto longer = std::make_unique<Stroke>(*stroke_);
            brush(*longer, dabs, progress);
            stroke_ = std::move(longer);
        }
        for (const auto& [name, value] : read.resolved.values()) stroke_->resolved.set(name, value);
        stroke_->warnings.insert(stroke_->warnings.end(), read.warnings.begin(),
                                 read.warnings.end());
        scene_.reset();
    }

    [[nodiscard]] const Scene& scene() const override {
        if (stroke_->dabs.empty()) return before_;
        if (!scene_) scene_ = scene_with(stroke_->brush.surface());
        return *scene_;
    }

    [[nodiscard]] const Arguments& resolved() const override {
        if (!stroke_->dabs.empty()) stroke_->resolved.set("dabs", listed(stroke_->dabs));
        return stroke_->resolved;
    }

    [[nodiscard]] Outcome outcome(Progress& progress) override {
        if (stroke_->dabs.empty()) throw_without_dabs(operation_);
        Outcome outcome;
        outcome.resolved = resolved();
        outcome.warnings = stroke_->warnings;
        if (stroke_->empty > 0)
            outcome.warnings.push_back(
                {.code = "dabs-without-effect",
                 .figures = {{"dabs", static_cast<double>(stroke_->empty)}}});
        if (settings_.kind != BrushKind::Weight) warn_if_coarse(stroke_->dabs.front(), outcome);
        BrushStroke ended = stroke_->brush;
        if (settings_.kind != BrushKind::Weight)
            warn_of_crossings(ended.keep_walls_apart(progress), "brush-crosses-walls",
                              {{.arguments = {{"strength", ""}}}}, outcome);
        outcome.scene = scene_with(ended.surface());
        ordered_json report = {{"dabs", stroke_->dabs.size()}};
        const Surface &before = surface_of(before_), &after = surface_of(outcome.scene);
        if (settings_.kind == BrushKind::Weight)
            report.update(painting(before, after, settings_.attribute));
        else
            report["volume_change_mm3"] = volume_change(before, after);
        outcome.report = std::make_shared<ordered_json>(std::move(report));
        return outcome;
    }

private:
    /// A stroke with its arguments and warnings.
    struct Stroke {
        BrushStroke brush;
        Arguments resolved;  ///< whose dabs are those added last
        std::vector<Diagnostic> warnings = {};
        std::vector<Dab> dabs = {};
        std::size_t empty = 0;  ///< dabs that changed no vertex
    };

    void brush(Stroke& stroke, const std::vector<Dab>& dabs, const Progress& progress) const {
        for (std::size_t i = 0; i < dabs.size(); ++i) {
            progress.report(static_cast<double>(i) / static_cast<double>(dabs.size()), "brushing");
            try {
                if (stroke.brush.add(dabs[i]).empty()) ++stroke.empty;
            } catch (const AlgorithmFailure& failure) {
                throw AlgorithmFailure(dab_name(operation_, stroke.dabs.size(), dabs[i]) + ": " +
                                       failure.what());
            }
            stroke.dabs.push_back(dabs[i]);
        }
    }

    /// Triangles of the brush's size show where it was as corners, or not at all.
    void warn_if_coarse(const Dab& dab, Outcome& outcome) const {
        const Vec3& at = dab.anchor.point;
        const double edge = mean_edge_near(surface_of(before_), *places_, {at, dab.radius});
        if (kFewestEdges * edge <= dab.radius) return;
        outcome.warnings.push_back(
            {.code = "brush-coarse",
             .place = at,
             .figures = {{"edge_mm", edge}, {"radius_mm", dab.radius}},
             .remedies = {{.operation = "remesh",
                           .arguments = {{"at", to_text(Value(rounded_place(at)))},
                                         {"within", to_text(Value(dab.radius))}},
                           .before = true}}});
    }

    /// `at` and what belongs to it make one dab; a stroke of several is given by `dabs` alone.
    void check_continued(const Arguments& more) const {
        const bool by_dabs = more.values().size() == 1 && more.has("dabs");
        if (!stroke_->dabs.empty() && (!by_dabs || stroke_->resolved.has("at")))
            throw UsageError(operation_ +
                             ": at makes a stroke of one dab; a longer one is given by dabs alone");
    }

    [[nodiscard]] Scene scene_with(Surface surface) const {
        if (settings_.kind != BrushKind::Weight) return with_surface(before_, std::move(surface));
        Scene scene = before_;  // its volume mesh still fits
        scene.surface = std::move(surface);
        return scene;
    }

    std::string operation_;
    BrushSettings settings_;
    Scene before_;
    std::shared_ptr<const SurfaceDistance> places_;
    std::unique_ptr<Stroke> stroke_;
    mutable std::optional<Scene> scene_;  ///< made on request
};

/// The arguments that say where to brush, or the others.
Arguments dab_part(const Arguments& arguments, bool dabs) {
    Arguments part;
    for (const auto& [name, value] : arguments.values())
        if (is_dab_argument(name) == dabs) part.set(name, value);
    return part;
}

std::unique_ptr<Stepper> live_brush(const std::string& operation, const BrushSettings& settings,
                                    const Scene& scene, const Arguments& arguments,
                                    Progress& progress) {
    auto live = std::make_unique<LiveBrush>(operation, settings, scene, dab_part(arguments, false));
    if (const Arguments dabs = dab_part(arguments, true); !dabs.values().empty())
        live->add(dabs, progress);
    return live;
}

std::unique_ptr<Stepper> live_smooth(const Scene& scene, const CheckedArguments& arguments,
                                     Progress& progress) {
    const BrushSettings settings{.kind = BrushKind::Smooth,
                                 .passes = static_cast<int>(arguments->integer("passes"))};
    return live_brush("brush-smooth", settings, scene, arguments, progress);
}

std::unique_ptr<Stepper> live_inflate(const Scene& scene, const CheckedArguments& arguments,
                                      Progress& progress) {
    return live_brush("brush-inflate", {.kind = BrushKind::Inflate}, scene, arguments, progress);
}

std::unique_ptr<Stepper> live_weight(const Scene& scene, const CheckedArguments& arguments,
                                     Progress& progress) {
    const std::string& name = arguments->text("attribute");
    check_attribute(name);
    return live_brush("brush-weight", {.kind = BrushKind::Weight, .attribute = name}, scene,
                      arguments, progress);
}

/// Each dab reaches along the wall from a place within one local radius of its anchor.
StatedChange brushed(const Scene&, const Outcome& outcome) {
    StatedChange stated{.keeps_triangles = true};
    stated.zones.emplace();
    for (const Arguments& dab : outcome.resolved.records("dabs").list())
        stated.zones->push_back(
            {dab.point("point"), dab.real("radius") + dab.real("vessel_radius")});
    return stated;
}

/// Common part of all brushes.
Operation brush(const std::string& name, double weakest, const std::string& summary,
                const std::string& strength) {
    return {.name = name,
            .usual_step = Step::LocalRepair,
            .allowed = {Step::Source, Step::Branches, Step::LocalRepair, Step::Openings,
                        Step::Smoothing, Step::Deformation, Step::Remeshing},
            .summary = summary,
            .parameters = dab_parameters(weakest, strength),
            .may_change = &brushed,
            .thesis = "4.2.3-4.2.4",
            .example = {.placed = {"at"},
                        .given = {{"radius", 0.5}, {"strength", 0.5}},
                        .changed = {{"strength", 0.4}}}};
}

}  // namespace

Operation brush_smooth_operation() {
    Operation operation =
        brush("brush-smooth", kSmoothWeakest,
              "smooth the wall under a brush; caps, rims and open boundaries are kept",
              "fraction of the way to the one-ring mean at the centre, per pass");
    operation.parameters.push_back({.name = "passes",
                                    .type = ParameterType::Integer,
                                    .default_value = std::int64_t{4},
                                    .help = "Laplace passes per dab; more passes smooth more",
                                    .minimum = 1,
                                    .maximum = 100});
    operation.start = &live_smooth;
    return operation;
}

Operation brush_inflate_operation() {
    Operation operation =
        brush("brush-inflate", kWeakest,
              "lift or lower the wall under a brush; caps, rims and open boundaries are kept",
              "the centre moves out by a tenth of the brush radius at 1, in at -1");
    operation.start = &live_inflate;
    return operation;
}

Operation brush_weight_operation() {
    Operation operation =
        brush("brush-weight", kWeakest, "paint a weight on the surface's vertices",
              "added to the weight, which is limited to 0 to 1");
    operation.parameters.push_back(
        {.name = "attribute",
         .type = ParameterType::Text,
         .default_value = "painted_weight",
         .help = "name of the vertex attribute to paint; created if absent",
         .meaning = Meaning::Name});
    operation.start = &live_weight;
    return operation;
}

}  // namespace vesselbench
