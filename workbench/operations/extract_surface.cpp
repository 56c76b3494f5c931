#include "geometry/image/extract_surface.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/handles.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/label_choice.h"
#include "workbench/case/measure_json.h"
#include "workbench/operations/extract_surface/parameters.h"
#include "workbench/operations/shared/handle_warnings.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// Dropped bodies that are larger than this fraction of the kept one cause a warning.
constexpr double kNoticeable = 0.05;

const Image& image_of(const Scene& scene) {
    if (!scene.image)
        throw DiagnosedFailure({.code = "no-image",
                                .operation = "extract-surface",
                                .remedies = {{.operation = "load-image"}}});
    return *scene.image;
}

/// All decisions, so that a replay repeats them.
Arguments resolved_from(const Arguments& given, const Extraction& extraction) {
    Arguments resolved = given;
    resolved.set("method", to_string(extraction.method));
    if (takes_voxels(extraction.method))
        resolved.set("labels",
                     std::vector<double>(extraction.labels.begin(), extraction.labels.end()));
    else if (extraction.levels)
        resolved.set("threshold", std::string("local"));
    else if (!given.has("iso"))
        resolved.set("threshold", extraction.threshold);
    if (!takes_voxels(extraction.method))
        resolved.set("inside", std::string(extraction.inside_below ? "below" : "above"));
    if (extraction.contrast) resolved.set("contrast", *extraction.contrast);
    return resolved;
}

nlohmann::ordered_json json_of(const VoxelTopology& topology) {
    return {{"components", topology.components},
            {"tunnels", topology.tunnels()},
            {"cavities", topology.cavities},
            {"euler", topology.euler}};
}

nlohmann::ordered_json json_of(const WallLevels& levels) {
    const Vec3& blur = levels.found.blur;
    return {{"lowest", levels.lowest},
            {"highest", levels.highest},
            {"contrast", levels.found.contrast},
            {"blur_mm", {blur.x(), blur.y(), blur.z()}},
            {"core_share", levels.core},
            {"volume_error_share", levels.volume_error},
            {"undetermined_share", levels.undetermined},
            {"volume_at_threshold_share", levels.volume_at_threshold}};
}

nlohmann::ordered_json cuts_of(const Surface& surface) {
    auto cuts = nlohmann::ordered_json::array();
    for (const PatchMeasures& patch : measure_patches(surface))
        if (patch.row > 0) cuts.push_back(patch_json(patch, Keys::WithUnits));
    return cuts;
}

/// "label 3", "labels 1 (artery), 2, 3", "117 labels from 1 to 117"
std::string labels_text(const std::vector<int>& labels, const std::vector<Segment>& segments) {
    constexpr std::size_t kMostListed = 12;
    if (labels.size() > kMostListed)
        return std::to_string(labels.size()) + " labels from " + std::to_string(labels.front()) +
               " to " + std::to_string(labels.back());
    std::vector<std::string> texts;
    for (const int label : labels) {
        const auto named = std::ranges::find(segments, label, &Segment::label);
        texts.push_back(std::to_string(label) +
                        (named == segments.end() ? "" : " (" + named->name + ")"));
    }
    return (texts.size() == 1 ? "label " : "labels ") + joined(texts);
}

/// ", 0.21 mm from the mask on average, at most 2.4 mm"; empty: there is none beside the image
std::string distance_text(const Extraction& extraction) {
    const auto& from = extraction.from_mask;
    return from ? ", " + formatted(from->mean, "%.2g") + " mm from the mask on average, at most " +
                      formatted(from->largest, "%.2g") + " mm"
                : "";
}

std::string way_of(const Extraction& extraction, const std::vector<Segment>& segments) {
    switch (extraction.method) {
        case ExtractionMethod::Threshold:
            if (const auto& levels = extraction.levels)
                return "levels " + formatted(levels->lowest) + " to " + formatted(levels->highest) +
                       " at the wall";
            return "threshold " + to_text(extraction.threshold);
        case ExtractionMethod::Labels:
            return labels_text(extraction.labels, segments);
        case ExtractionMethod::Masked:
            return "the mask as a region, " +
                   (extraction.levels ? "levels " + formatted(extraction.levels->lowest) + " to " +
                                            formatted(extraction.levels->highest) + " at the wall"
                                      : "threshold " + to_text(extraction.threshold));
        case ExtractionMethod::Wall:
            return "the mask as the wall, moved to the image's edges (on " +
                   formatted(100.0 * extraction.from_mask->seen, "%.0f") + " % of it)";
    }
    return "";
}

std::string headline_of(const Extraction& extraction, const std::vector<Segment>& segments) {
    return way_of(extraction, segments) + distance_text(extraction);
}

/// Labels of several structures may touch, and become one body.
void warn_of_all_labels(const Extraction& extraction, const std::vector<Segment>& segments,
                        Outcome& outcome) {
    std::vector<int> labels = extraction.labels;
    std::erase(labels, 0);
    if (labels.size() < 2) return;
    outcome.warnings.push_back(
        {.code = "all-labels-taken",
         .words = {{"labels", labels_text(labels, segments)}},
         .remedies = {{.arguments = {{"labels", std::to_string(labels[0]) + "," +
                                                    std::to_string(labels[1])}}}}});
}

Report report_of(const Extraction& extraction, const std::vector<Segment>& segments) {
    const Surface& surface = extraction.surface;
    nlohmann::ordered_json report = {{"headline", headline_of(extraction, segments)},
                                     {"method", to_string(extraction.method)},
                                     {"threshold", extraction.threshold},
                                     {"decisions", extraction.reasons},
                                     {"vertices", surface.vertex_count()},
                                     {"triangles", surface.triangle_count()}};
    report.update(extent_json(volume(surface), area(surface)));
    report.update({{"bodies_found", extraction.bodies},
                   {"hollows_found", extraction.hollows},
                   {"largest_dropped_mm3", extraction.largest_dropped},
                   {"cuts_at_border", cuts_of(surface)}});
    if (extraction.levels) report["levels"] = json_of(*extraction.levels);
    if (const auto& lumen = extraction.lumen)
        report["lumen"] = {{"grazes", lumen->grazes},        {"closing_voxels", lumen->closing},
                           {"loops_before", lumen->loops},   {"filled_share", lumen->filled},
                           {"joined_voxels", lumen->joined}, {"one_voxel_wide", lumen->chain}};
    if (const auto& from = extraction.from_mask)
        report["distance_from_mask_mm"] = {{"mean", from->mean}, {"largest", from->largest}};
    if (extraction.between_slices == BetweenSlices::Curved) report["between_slices"] = "curved";
    if (extraction.method == ExtractionMethod::Wall)
        report["edges_share"] = extraction.from_mask->seen;
    if (extraction.before) {
        report["topology_before_cleaning"] = json_of(*extraction.before);
        report["topology_after_cleaning"] = json_of(*extraction.after);
    }
    return std::make_shared<nlohmann::ordered_json>(std::move(report));
}

/// A volume error, or a part of the wall, below it is no news.
constexpr double kNoticeableError = 0.05;

/// What is uncertain where vessels are thin.
std::vector<Diagnostic> thin_warnings(const Extraction& extraction) {
    std::vector<Diagnostic> warnings;
    if (!extraction.why_no_levels.empty())
        warnings.push_back(
            {.code = "one-threshold", .words = {{"reason", extraction.why_no_levels}}});
    if (!extraction.levels) return warnings;
    const WallLevels& levels = *extraction.levels;
    const Vec3& blur = levels.found.blur;
    const std::string blurred = formatted(blur.x(), "%.2g") + " x " + formatted(blur.y(), "%.2g") +
                                " x " + formatted(blur.z(), "%.2g");
    if (levels.volume_error > kNoticeableError)
        warnings.push_back({.code = "volume-uncertain",
                            .figures = {{"volume_percent", 100.0 * levels.volume_error},
                                        {"core_percent", 100.0 * levels.core}},
                            .words = {{"blur", blurred}}});
    if (levels.undetermined > kNoticeableError)
        warnings.push_back({.code = "radius-undetermined",
                            .figures = {{"wall_percent", 100.0 * levels.undetermined}},
                            .words = {{"blur", blurred}}});
    return warnings;
}

/// Of bodies that are not kept, though they are long or large.
void add_dropped(const Extraction& extraction, std::vector<Diagnostic>& warnings) {
    const auto bodies = static_cast<double>(extraction.bodies);
    const double kept = volume(extraction.surface);
    const Remedy all{.arguments = {{"component", "all"}}};
    if (const auto& vessel = extraction.dropped_vessel)
        warnings.push_back({.code = "vessel-dropped",
                            .place = vessel->centre,
                            .figures = {{"bodies", bodies},
                                        {"length_mm", vessel->length},
                                        {"diameter_mm", vessel->diameter}},
                            .remedies = {{.arguments = {{"closing", "1"}}}, all}});
    if (extraction.largest_dropped > kNoticeable * kept)
        warnings.push_back({.code = "body-dropped",
                            .figures = {{"bodies", bodies},
                                        {"dropped_mm3", extraction.largest_dropped},
                                        {"kept_mm3", kept}},
                            .remedies = {{.arguments = {{"seed", ""}}}, all}});
}

std::string text_of(const VoxelTopology& t) {
    return counted(t.components, "piece") + ", " + counted(t.tunnels(), "tunnel") + ", " +
           counted(t.cavities, "cavity", "cavities");
}

/// Of a mask: what was added to it, and where it does not say how wide a vessel is.
void add_lumen(const Extraction& extraction, std::vector<Diagnostic>& warnings) {
    const auto& lumen = extraction.lumen;
    if (!lumen) return;
    if (lumen->grazes > 0)
        warnings.push_back({.code = "wall-touches-border",
                            .figures = {{"places", static_cast<double>(lumen->grazes)}},
                            .remedies = {{.arguments = {{"mask_surface", "smooth"}}}}});
    if (lumen->closing > 0)
        warnings.push_back(
            {.code = "missing-voxels-filled",
             .figures = {{"loops", static_cast<double>(lumen->loops)},
                         {"voxels_percent", 100.0 * lumen->filled}},
             .remedies = {{.arguments = {{"closing", std::to_string(lumen->closing)}}},
                          {.arguments = {{"mask_surface", "smooth"}}}}});
    if (lumen->joined > 0)
        warnings.push_back({.code = "voxels-joined",
                            .figures = {{"voxels", static_cast<double>(lumen->joined)}},
                            .remedies = {{.arguments = {{"mask_surface", "smooth"}}}}});
    if (lumen->chain > 0)
        warnings.push_back(
            {.code = "width-below-voxels",
             .place = lumen->place,
             .figures = {{"voxels", static_cast<double>(lumen->chain)},
                         {"width_mm", 2.0 * extraction.sampling.spacing.minCoeff()}}});
}

std::vector<Diagnostic> warnings_of(const Extraction& extraction) {
    std::vector<Diagnostic> warnings = thin_warnings(extraction);
    add_lumen(extraction, warnings);
    add_dropped(extraction, warnings);
    if (extraction.before && !(*extraction.before == *extraction.after))
        warnings.push_back({.code = "cleaning-changed-topology",
                            .words = {{"before", text_of(*extraction.before)},
                                      {"after", text_of(*extraction.after)}}});
    if (const std::size_t patches = extraction.surface.patches.size(); patches > 1)
        warnings.push_back({.code = "vessel-leaves-image",
                            .figures = {{"places", static_cast<double>(patches - 1)}}});
    return warnings;
}

/// Labels are integers; an image with fractions was most likely measured. \return true if it warns
bool warn_of_fractions(const Image& image, Outcome& outcome) {
    const auto fraction =
        std::ranges::find_if(*image.voxels, [](float v) { return v != std::floor(v); });
    if (fraction == image.voxels->end()) return false;
    outcome.warnings.push_back({.code = "not-a-label-map",
                                .words = {{"value", to_text(*fraction)}},
                                .remedies = {{.arguments = {{"method", "threshold"}}}}});
    return true;
}

/// Names the closing in the warnings of handles that it fills. \return true if it fills any
bool note_filled(std::vector<Diagnostic>& warnings, const Surface& closed, int radius,
                 const Progress& progress) {
    const int left = connectivity(*closed.topology).genus.value_or(0);
    const Remedy remedy{.arguments = {{"closing", std::to_string(radius)}}};
    if (const auto many = warnings.front().figures.find("handles");
        many != warnings.front().figures.end()) {
        if (2.0 * left > many->second) return false;
        warnings.front().figures["left"] = left;
        warnings.front().remedies = {remedy};
        return true;
    }
    if (left >= static_cast<int>(warnings.size())) return false;
    const std::vector<SurfaceHandle> handles =
        left > 0 ? handles_of(closed, progress.silent()) : std::vector<SurfaceHandle>();
    bool any = false;
    for (Diagnostic& warning : warnings) {
        const double reach = warning.figures.at("length_mm");
        const bool stays = std::ranges::any_of(handles, [&](const SurfaceHandle& handle) {
            return (handle.centre - *warning.place).norm() < reach;
        });
        if (stays) continue;
        warning.code = "pillar-in-lumen";
        warning.remedies = {remedy};
        any = true;
    }
    return any;
}

class LiveExtraction final : public ReplacingStepper {
public:
    LiveExtraction(const Scene& scene, const Arguments& arguments, Progress& progress)
        : ReplacingStepper(arguments), before_(scene), extractor_(image_of(scene), scene.mask) {
        use(arguments, progress);
    }

    [[nodiscard]] const Scene& scene() const override { return scene_; }

    [[nodiscard]] const Arguments& resolved() const override { return resolved_; }

    [[nodiscard]] Outcome outcome(Progress& progress) override {
        Outcome outcome{.scene = scene_,
                        .report = report_of(extraction_, before_.segmentation.segments),
                        .resolved = resolved_,
                        .warnings = warnings_of(extraction_)};
        const bool measured = extraction_.method == ExtractionMethod::Labels &&
                              warn_of_fractions(image_of(before_), outcome);
        warn_of_one_threshold(outcome, progress);
        for (Diagnostic& handle : warnings_of_handles(progress))
            outcome.warnings.push_back(std::move(handle));
        if (!measured && !labels_given_)
            warn_of_all_labels(extraction_, before_.segmentation.segments, outcome);
        return outcome;
    }

private:
    /// With the volume that local levels give.
    void warn_of_one_threshold(Outcome& outcome, const Progress& progress) {
        if (extraction_.levels || !extraction_.why_no_levels.empty()) return;
        const auto error = extractor_.volume_error(parameters_, progress);
        if (!error || std::abs(*error) <= kNoticeableError) return;
        outcome.warnings.push_back({.code = "threshold-changes-volume",
                                    .figures = {{"volume_percent", 100.0 * std::abs(*error)}},
                                    .words = {{"threshold", to_text(extraction_.threshold)},
                                              {"larger", *error > 0.0 ? "larger" : "smaller"}},
                                    .remedies = {{.arguments = {{"threshold", "local"}}}}});
    }

    /// Of a mask, with the closing that fills what passes through the lumen, where one does.
    [[nodiscard]] std::vector<Diagnostic> warnings_of_handles(const Progress& progress) {
        std::vector<Diagnostic> warnings = handle_warnings(extraction_.surface, progress);
        if (warnings.empty() || !takes_voxels(extraction_.method) ||
            parameters_.cleaning.closing > 0)
            return warnings;
        constexpr int kWidest = 3;  // voxels; more joins vessels
        for (int radius = 1; radius <= kWidest; ++radius) {
            ExtractionParameters closing = parameters_;
            closing.cleaning.closing = radius;
            const Surface closed = extractor_.extract(closing, progress.silent()).surface;
            if (note_filled(warnings, closed, radius, progress)) break;
        }
        return warnings;
    }

    void use(const Arguments& arguments, Progress& progress) override {
        ExtractionParameters parameters =
            extraction_parameters(arguments, before_.mask.has_value(), before_.segmentation.vessel);
        Extraction extraction = extractor_.extract(parameters, progress);
        parameters_ = std::move(parameters);
        Arguments resolved = resolved_from(arguments, extraction);
        labels_given_ = !parameters_.labels.empty();
        scene_ = with_surface(before_, extraction.surface);
        scene_.sampling = extraction.sampling;
        resolved_ = std::move(resolved);
        extraction_ = std::move(extraction);
    }

    Scene before_;
    SurfaceExtractor extractor_;
    ExtractionParameters parameters_;
    Extraction extraction_;
    bool labels_given_ = false;
    Scene scene_;
    Arguments resolved_;
};

Arguments decided_extraction(const Scene& scene, const CheckedArguments& arguments,
                             const Progress& progress) {
    const ExtractionParameters decided =
        SurfaceExtractor(image_of(scene), scene.mask)
            .decided(
                extraction_parameters(arguments, scene.mask.has_value(), scene.segmentation.vessel),
                progress);
    Arguments found{{"method", to_string(*decided.method)}};
    if (decided.method != ExtractionMethod::Threshold && !arguments->has("labels")) {
        const std::vector<int> all =
            decided.labels.empty() ? labels_of(label_image(scene)) : decided.labels;
        found.set("labels", std::vector<double>(all.begin(), all.end()));
    }
    if (takes_voxels(*decided.method)) return found;
    found.set("threshold",
              decided.local_levels ? Value(std::string("local")) : Value(*decided.threshold));
    found.set("inside", std::string(*decided.inside_below ? "below" : "above"));
    return found;
}

std::vector<Parameter> threshold_parameters() {
    using enum ParameterType;
    const Condition of_intensities{"method", {"auto", "threshold", "masked"}};
    return {
        {.name = "method",
         .type = Choice,
         .default_value = "auto",
         .help =
             "threshold: intensities or a level set; labels: chosen labels of the mask or "
             "label map; masked: intensities inside the dilated mask; wall: the mask's surface, "
             "moved by at most a voxel to the edge that the image has there; auto: masked if "
             "there is a mask, labels for a label map, else threshold",
         .choices = {"auto", "threshold", "labels", "masked", "wall"}},
        {.name = "threshold",
         .unit = "-",
         .help = "image value at the vessel's boundary; midway: between the medians of the voxels "
                 "inside and outside the wall, that of the mask, else of the brightest voxels; "
                 "local: at "
                 "each place what the image's blur leaves of the contrast there, lower at thin "
                 "vessels; "
                 "default: local for intensities, 0 for a level set",
         .choices = {"local", "midway"},
         .only_with = of_intensities},
        {.name = "iso",
         .unit = "-",
         .help = "synonym of threshold, for level sets",
         .only_with = of_intensities,
         .use = Use::IfGiven},
        {.name = "inside",
         .type = Choice,
         .help = "side of the threshold on which the vessel lies; default: above, or for a level "
                 "set the side away from the image's border",
         .choices = {"above", "below"},
         .only_with = of_intensities}};
}

/// Of labels and masks, and which bodies are kept.
std::vector<Parameter> label_parameters() {
    using enum ParameterType;
    return {
        {.name = "labels",
         .type = List,
         .help = "labels of the vessel, as 1,2,3; default: every label above 0",
         .minimum = 1,
         .only_with = Condition{"method", {"auto", "labels", "masked", "wall"}},
         .meaning = Meaning::Labels},
        {.name = "mask_surface",
         .type = Choice,
         .default_value = "smooth",
         .help =
             "surface of labels: smooth, where it bends least with every voxel on its side; "
             "lumen, the same, but no narrower than the voxels, whole where they touch at edges "
             "and corners only, with missing voxels filled, and closed where its wall touches "
             "the image's border; or midway between voxels, with their staircases",
         .choices = {"smooth", "lumen", "midway"},
         .only_with = Condition{"method", {"auto", "labels", "wall"}}},
        {.name = "between_slices",
         .type = Choice,
         .default_value = "straight",
         .help = "smooth surface of a mask in slices at least 3.5 times as thick as its voxels: "
                 "straight from slice to slice, with ridges where the vessel runs obliquely, or "
                 "curved as within slices",
         .choices = {"straight", "curved"},
         .only_with = Condition{"method", {"auto", "labels", "wall"}}},
        {.name = "freed_sides",
         .type = Choice,
         .default_value = "all",
         .help = "where a wall touches the image's border, the lumen's mask goes on for a voxel "
                 "behind all sides, and ends that other sides cut become longer by it, or behind "
                 "the touched sides alone",
         .choices = {"all", "touched"},
         .only_with = Condition{"method", {"auto", "labels", "wall"}},
         .use = Use::Rare},
        {.name = "dilation",
         .type = Integer,
         .unit = "voxels",
         .default_value = std::int64_t{1},
         .help = "dilation of the mask before it limits the intensities",
         .minimum = 0,
         .maximum = 50,
         .only_with = Condition{"method", {"auto", "masked"}}},
        {.name = "component",
         .type = Choice,
         .default_value = "largest",
         .help = "which bodies to keep; seed overrides it",
         .choices = {"largest", "all"}},
        {.name = "seed",
         .type = Point,
         .unit = "mm",
         .help = "point inside the vessel to keep (LPS)",
         .meaning = Meaning::Seed}};
}

std::vector<Parameter> cleaning_parameters() {
    using enum ParameterType;
    return {{.name = "diffusion",
             .type = Integer,
             .default_value = std::int64_t{0},
             .help = "iterations of edge-preserving diffusion on intensities; 0: none",
             .minimum = 0,
             .maximum = 1000,
             .use = Use::Rare},
            {.name = "contrast",
             .unit = "-",
             .help = "differences above it count as edges in the diffusion; default: from the "
                     "image's noise",
             .minimum = 0.0,
             .above_minimum = true,
             .only_with = Condition{"diffusion"},
             .use = Use::Rare},
            {.name = "gaussian",
             .unit = "mm",
             .default_value = 0.0,
             .help = "standard deviation of Gaussian smoothing; 0: none",
             .minimum = 0.0,
             .maximum = 100.0,
             .use = Use::Rare},
            {.name = "opening",
             .type = Integer,
             .unit = "voxels",
             .default_value = std::int64_t{0},
             .help = "removes structures thinner than twice this plus one voxel; 0: none",
             .minimum = 0,
             .maximum = 50,
             .use = Use::Rare},
            {.name = "closing",
             .type = Integer,
             .unit = "voxels",
             .default_value = std::int64_t{0},
             .help = "fills gaps narrower than twice this plus one voxel; 0: none",
             .minimum = 0,
             .maximum = 50,
             .use = Use::Rare},
            {.name = "resample",
             .unit = "mm",
             .help = "edge of cubic voxels to resample to (cubic B-spline; masks by shape); "
                     "default: the image's own voxels",
             .minimum = 0.0,
             .above_minimum = true,
             .use = Use::Rare}};
}

}  // namespace

Operation extract_surface_operation() {
    std::vector<Parameter> parameters = threshold_parameters();
    for (const auto& more : {label_parameters(), cleaning_parameters()})
        parameters.insert(parameters.end(), more.begin(), more.end());
    return {.name = "extract-surface",
            .usual_step = Step::Source,
            .allowed = {Step::Source},
            .summary = "make a surface from the image by threshold, labels or both",
            .parameters = std::move(parameters),
            .start = &started<LiveExtraction>,
            .decided = &decided_extraction,
            .thesis = "3.2.1-3.2.3",
            .recipe = {.makes_source = true},
            .example = {.scene = ExampleScene::Image, .changed = {{"gaussian", 0.125}}}};
}

}  // namespace vesselbench
