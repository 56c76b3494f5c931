#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "workbench/case/label_choice.h"
#include "workbench/operations/shared/surface_argument.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// The labels that the arguments list or name.
std::vector<int> labels_of_neighbour(const Scene& scene, const Arguments& arguments) {
    if (const auto name = arguments.optional_text("segment"))
        return labels_named(*name, scene.segmentation.segments, labels_of(label_image(scene)));
    std::vector<int> labels;
    for (const double label : arguments.list("labels")) {
        if (label != std::floor(label) || label < 1.0 || label > 1e6)
            throw UsageError("load-neighbour: labels are integers, 1 or above");
        labels.push_back(static_cast<int>(label));
    }
    return labels;
}

Surface surface_of_labels(const Scene& scene, const Arguments& arguments,
                          const Progress& progress) {
    if (!scene.image)
        throw DiagnosedFailure({.code = "labels-without-image",
                                .operation = "load-neighbour",
                                .remedies = {{.operation = "load-image"}}});
    ExtractionParameters parameters{.method = ExtractionMethod::Labels,
                                    .mask_surface = arguments.text("mask_surface") == "smooth"
                                                        ? MaskSurface::Smooth
                                                        : MaskSurface::Midway,
                                    .bodies = Bodies::All};
    parameters.labels = labels_of_neighbour(scene, arguments);
    return extract_surface(*scene.image, scene.mask, parameters, progress).surface;
}

/// One of them says what the neighbour is.
constexpr const char* kSources[] = {"file", "labels", "segment"};

Outcome load(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const auto given =
        std::ranges::count_if(kSources, [&](const char* source) { return arguments.has(source); });
    if (given != 1)
        throw DiagnosedUsage(
            {.code = "neighbour-without-source",
             .operation = "load-neighbour",
             .remedies = {{.arguments = {{"file", ""}}}, {.arguments = {{"labels", ""}}}}});
    const std::string& name = arguments.text("name");
    Outcome outcome{.scene = scene, .resolved = arguments};
    bool turned = false;
    Surface neighbour;
    if (arguments.has("file")) {
        SurfaceArgument read = read_surface_argument("load-neighbour", arguments, outcome);
        neighbour = std::move(read.surface);
        turned = read.turned;
    } else {
        neighbour = surface_of_labels(scene, arguments, progress);
    }
    if (neighbour.empty()) throw InvalidInput("the neighbour's surface has no triangles");
    nlohmann::ordered_json report = {{"name", name},
                                     {"vertices", neighbour.vertex_count()},
                                     {"triangles", neighbour.triangle_count()},
                                     {"volume_mm3", volume(neighbour)}};
    if (turned) report["headline"] = "turned from RAS to LPS";
    outcome.report = std::make_shared<nlohmann::ordered_json>(std::move(report));
    outcome.scene.neighbours[name] = std::move(neighbour);
    return outcome;
}

}  // namespace

Operation load_neighbour_operation() {
    using enum ParameterType;
    return {.name = "load-neighbour",
            .usual_step = Step::Source,
            .allowed = {Step::Source},
            .summary = "add a neighbouring structure, whose distance smoothing can preserve",
            .parameters = {{.name = "name",
                            .type = Text,
                            .help = "its name; a second one of the same name replaces the first",
                            .required = true,
                            .meaning = Meaning::Name},
                           {.name = "file", .type = File, .help = "a surface file"},
                           {.name = "labels",
                            .type = List,
                            .help = "labels of the mask or label map instead of a file, as 1,2,3",
                            .minimum = 1},
                           {.name = "segment",
                            .type = Text,
                            .help = "names of segments of the mask or label map instead of labels, "
                                    "as bone"},
                           {.name = "mask_surface",
                            .type = Choice,
                            .default_value = "smooth",
                            .help = "surface of labels, as when one is extracted from an image",
                            .choices = {"smooth", "midway"},
                            .only_with = Condition{"labels"}},
                           units_parameter(),
                           space_parameter()},
            .run = &load,
            .isolated = true,
            .thesis = "5.2",
            .recipe = {.loads = InputKind::Neighbour},
            .example = {.changed = {{"name", std::string("vein")}}}};
}

}  // namespace vesselbench
