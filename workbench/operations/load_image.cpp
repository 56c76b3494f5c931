#include <algorithm>
#include <sstream>

#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/image/mask_grid.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/load_image/label_map.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// Voxels shorter than this [mm] in a file that states no unit: the file is in metres.
constexpr double kTooSmallVoxel = 0.02;

double millimetres_in(const std::string& unit) {
    return unit == "m" ? 1000.0 : unit == "cm" ? 10.0 : unit == "um" ? 1e-3 : 1.0;
}

std::string unit_of(double millimetres) {
    return millimetres == 1000.0 ? "m"
           : millimetres == 10.0 ? "cm"
           : millimetres < 1.0   ? "um"
                                 : "mm";
}

Image scaled(Image image, double factor) {
    image.index_to_patient.topRows<3>() *= factor;
    return image;
}

/// Applies the unit: the user's, else the file's, else one guessed from the voxels.
Image in_millimetres(const ImageFile& file, Outcome& outcome) {
    const double stated = file.unit.value_or(1.0);
    if (const auto given = outcome.resolved.optional_text("units"))
        return scaled(file.image, millimetres_in(*given) / stated);
    std::string unit = unit_of(stated);
    double factor = 1.0;
    if (!file.unit && file.image.spacing().maxCoeff() < kTooSmallVoxel) {
        unit = "m";
        factor = millimetres_in(unit);
        std::ostringstream spacing;
        spacing << file.image.spacing().transpose();
        outcome.warnings.push_back({.code = "voxels-too-small",
                                    .words = {{"spacing", spacing.str()}},
                                    .remedies = {{.arguments = {{"units", ""}}}}});
    }
    outcome.resolved.set("units", unit);
    return scaled(file.image, factor);
}

/// A mask that states no unit has the image's.
Image mask_in_millimetres(const ImageFile& mask, bool unit_given, double image_unit) {
    if (mask.unit && !unit_given) return mask.image;
    return scaled(mask.image, image_unit / mask.unit.value_or(1.0));
}

/// A mask of labels unchanged, or a level set converted to 1 inside and 0 outside.
Image usable_mask(const Image& mask, Outcome& outcome) {
    Arguments& resolved = outcome.resolved;
    const ImageJudgement judgement = judge(mask);
    const bool wants_iso = resolved.has("mask_iso") || resolved.has("mask_inside");
    if (judgement.kind == ImageKind::Labels && !wants_iso) return mask;
    if (judgement.kind == ImageKind::Intensity && !resolved.has("mask_iso"))
        throw DiagnosedInput({.code = "mask-of-intensities",
                              .operation = "load-image",
                              .remedies = {{.arguments = {{"mask_iso", ""}}}}});
    if (!wants_iso)
        outcome.warnings.push_back(
            {.code = "mask-not-labels", .words = {{"reason", judgement.reason}}});
    if (!resolved.has("mask_iso")) resolved.set("mask_iso", 0.0);
    if (!resolved.has("mask_inside"))
        resolved.set("mask_inside", std::string(judgement.inside_below ? "below" : "above"));
    return mask_of_iso(mask, resolved.real("mask_iso"), resolved.text("mask_inside") == "below");
}

/// The patient directions closest to the axes, as letters: "LPS", "RAI" ...
std::string axis_letters(const Image& image) {
    static constexpr char kPositive[] = {'L', 'P', 'S'}, kNegative[] = {'R', 'A', 'I'};
    std::string letters;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Eigen::Index nearest = 0;
        const Vec3 direction = image.index_to_patient.block<3, 1>(0, axis);
        direction.cwiseAbs().maxCoeff(&nearest);
        letters += direction[nearest] > 0.0 ? kPositive[nearest] : kNegative[nearest];
    }
    return letters;
}

nlohmann::ordered_json report_of(const ImageFile& file, const Image& image) {
    const auto [least, most] = std::minmax_element(image.voxels->begin(), image.voxels->end());
    const Eigen::Matrix3d axes = image.index_to_patient.topLeftCorner<3, 3>();
    return {{"format", file.format},
            {"size_voxels", image.size},
            {"spacing_mm", point_json(image.spacing())},
            {"first_voxel_mm", point_json(image.index_to_patient.topRightCorner<3, 1>())},
            {"axes_point_to", axis_letters(image)},
            {"left_handed", axes.determinant() < 0.0},
            {"values", {*least, *most}},
            {"kind", to_string(judge(image).kind)}};
}

std::string grid_text(const Image& image) {
    std::ostringstream text;
    text << image.size[0] << " x " << image.size[1] << " x " << image.size[2] << " voxels of "
         << formatted(image.spacing().x()) << " x " << formatted(image.spacing().y()) << " x "
         << formatted(image.spacing().z()) << " mm";
    return text.str();
}

/// More of a mask beyond its image is worth a warning.
constexpr double kNoticeableLoss = 0.001;

/// The mask on the image's grid; the report and warnings say what was done for it.
Image placed_mask(const Image& image, const Image& mask, Outcome& outcome,
                  nlohmann::ordered_json& report) {
    const PlacedMask placed = mask_on_grid(image, mask);
    static constexpr const char* kGrids[] = {"same", "part of the image's lattice", "resampled"};
    report["mask_grid"] = kGrids[static_cast<std::size_t>(placed.grid)];
    if (placed.grid == MaskGrid::Resampled)
        outcome.warnings.push_back(
            {.code = "mask-resampled",
             .words = {{"mask", grid_text(mask)}, {"image", grid_text(image)}}});
    if (placed.beyond > kNoticeableLoss)
        outcome.warnings.push_back(
            {.code = "mask-beyond-image", .figures = {{"lost_percent", 100.0 * placed.beyond}}});
    return placed.mask;
}

/// What names labels is no text for intensities.
void refuse_choice(const Arguments& arguments, const std::string& what) {
    if (arguments.has("label"))
        throw UsageError("label chooses segments of a label map, but " + what);
}

void add_segments(const Segmentation& segmentation, const Image& labels,
                  nlohmann::ordered_json& report) {
    if (segmentation.empty()) return;
    auto list = nlohmann::ordered_json::array();
    for (const auto& [label, volume] : label_volumes(labels))
        list.push_back({{"label", label},
                        {"name", name_of_label(segmentation.segments, label)},
                        {"volume_ml", volume / 1000.0}});
    report["segments"] = list;
    if (!segmentation.vessel.empty()) report["vessel_labels"] = segmentation.vessel;
}

void load_mask(const Arguments& arguments, const Image& image, Outcome& outcome,
               nlohmann::ordered_json& report) {
    const std::string choice = arguments.optional_text("label").value_or("");
    ImageFile file = read_segmentation_file(arguments.text("mask"));
    join_layers(file, choice);
    const Image mask = mask_in_millimetres(file, arguments.has("units"),
                                           millimetres_in(outcome.resolved.text("units")));
    const Image whole = usable_mask(mask, outcome);
    const Image usable = placed_mask(image, whole, outcome, report);
    const auto inside = std::count_if(usable.voxels->begin(), usable.voxels->end(),
                                      [](float v) { return v > 0.0f; });
    if (inside == 0) throw InvalidInput("the mask is empty: none of its voxels is inside");
    report["mask_voxels"] = inside;
    report["mask_labels"] = labels_of(usable);
    outcome.scene.mask = usable;
    if (outcome.resolved.has("mask_iso"))
        return refuse_choice(arguments, "the mask is bounded by a value");
    outcome.scene.segmentation = segmentation_of(usable, file.segments, choice);
    add_segments(outcome.scene.segmentation, usable, report);
}

/// The names of an image's own labels, and what is chosen of them.
void name_labels(const Arguments& arguments, const ImageFile& file, const Image& image,
                 Outcome& outcome, nlohmann::ordered_json& report) {
    if (file.segments.empty() && judge(image).kind != ImageKind::Labels)
        return refuse_choice(arguments, "the image holds none");
    outcome.scene.segmentation =
        segmentation_of(image, file.segments, arguments.optional_text("label").value_or(""));
    add_segments(outcome.scene.segmentation, image, report);
}

Outcome load_image(const Scene& scene, const Arguments& arguments, Progress& progress) {
    Outcome outcome;
    outcome.resolved = arguments;
    progress.report(0.0, "reading the image");
    const bool with_mask = arguments.has("mask");
    ImageFile file = with_mask ? read_image_file(arguments.text("file"))
                               : read_segmentation_file(arguments.text("file"));
    join_layers(file, arguments.optional_text("label").value_or(""));
    const Image image = in_millimetres(file, outcome);
    const auto [least, most] = std::minmax_element(image.voxels->begin(), image.voxels->end());
    if (*most <= *least)
        throw InvalidInput("the image is empty: all its voxels have the same value");
    for (const std::string& note : file.notes)
        outcome.warnings.push_back({.code = "file-note", .words = {{"note", note}}});
    nlohmann::ordered_json report = report_of(file, image);
    outcome.scene = scene;
    outcome.scene.image = image;
    outcome.scene.mask.reset();
    outcome.scene.segmentation = {};
    if (!with_mask) {
        name_labels(arguments, file, image, outcome, report);
    } else {
        progress.report(0.6, "reading the mask");
        load_mask(arguments, image, outcome, report);
    }
    outcome.report = std::make_shared<nlohmann::ordered_json>(std::move(report));
    return outcome;
}

}  // namespace

Operation load_image_operation() {
    using enum ParameterType;
    return {.name = "load-image",
            .usual_step = Step::Source,
            .allowed = {Step::Source},
            .summary = "load an image or a label map, and its mask, with their true orientation",
            .parameters =
                {{.name = "file", .type = File, .help = image_formats_text(), .required = true},
                 {.name = "mask",
                  .type = File,
                  .help = "segmentation of the image: labels (0 is outside) or a level set; on "
                          "another grid than the image's it is resampled by shape"},
                 {.name = "label",
                  .type = Text,
                  .help = "segments that are the vessel, of the mask, else of the label map: names "
                          "or labels, as artery or 1,2, or all; default: extract-surface chooses"},
                 {.name = "units",
                  .type = Choice,
                  .help = "unit of length of the file; default: the unit stated in the file, else "
                          "mm, or m if the voxels would be too small for mm",
                  .choices = {"mm", "cm", "m", "um"}},
                 {.name = "mask_iso",
                  .unit = "-",
                  .help = "value that bounds the mask's inside; default: 0 for a level set, any "
                          "label above 0 for labels",
                  .only_with = Condition{"mask"},
                  .use = Use::Rare},
                 {.name = "mask_inside",
                  .type = Choice,
                  .help = "side of mask_iso that is inside; default: above, or for a level set the "
                          "side away from the image's border",
                  .choices = {"above", "below"},
                  .only_with = Condition{"mask"},
                  .use = Use::Rare}},
            .run = &load_image,
            .isolated = true,
            .thesis = "3.2",
            .recipe = {.loads = InputKind::Image},
            .example = {.changed = {{"units", std::string("mm")}}}};
}

}  // namespace vesselbench
