#include <nlohmann/json.hpp>

#include "geometry/image/crop_image.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/vessel/openings/crop_surface.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// A box, or a ball if `radius` is set.
struct Region {
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
    Vec3 centre = Vec3::Zero();
    std::optional<double> radius;
};

Region region_from(const Arguments& arguments) {
    Region region;
    const bool box = arguments.has("box");
    const bool sphere = arguments.has("centre") || arguments.has("radius");
    if (box == sphere)
        throw DiagnosedUsage(
            {.code = "no-crop-region",
             .operation = "crop",
             .remedies = {{.arguments = {{"box", ""}}}, {.arguments = {{"centre", ""}}}}});
    if (box) {
        const auto& numbers = arguments.list("box");
        if (numbers.size() != 6)
            throw UsageError("crop: box is six numbers x0,y0,z0,x1,y1,z1 in mm");
        region.low = Vec3(numbers[0], numbers[1], numbers[2]);
        region.high = Vec3(numbers[3], numbers[4], numbers[5]);
        if (!((region.high - region.low).minCoeff() > 0.0))
            throw UsageError("crop: box is empty: x1, y1, z1 must be above x0, y0, z0");
    } else {
        region.centre = arguments.point("centre");
        region.radius = arguments.real("radius");
    }
    return region;
}

Image cropped(const Image& image, const Region& region) {
    return region.radius ? crop_to_sphere(image, region.centre, *region.radius)
                         : crop_to_box(image, region.low, region.high);
}

Surface cropped(const Surface& surface, const Region& region) {
    return region.radius ? crop_to_sphere(surface, region.centre, *region.radius)
                         : crop_to_box(surface, region.low, region.high);
}

Outcome crop(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Region region = region_from(arguments);
    if (!scene.image && !scene.surface)
        throw DiagnosedFailure(
            {.code = "nothing-to-crop",
             .operation = "crop",
             .remedies = {{.operation = "load-image"}, {.operation = "load-surface"}}});
    Outcome outcome;
    outcome.scene = scene;
    outcome.resolved = arguments;
    nlohmann::ordered_json report;
    if (scene.image) {
        outcome.scene.image = cropped(*scene.image, region);
        report["image_size_before_voxels"] = scene.image->size;
        report["image_size_voxels"] = outcome.scene.image->size;
    }
    if (scene.mask) outcome.scene.mask = cropped(*scene.mask, region);
    progress.report(0.5, "cropping the surface");
    if (scene.surface) {
        Surface part = cropped(*scene.surface, region);
        const LargestPiece piece = largest_piece(part);
        if (arguments.text("component") == "largest") part = piece.surface;
        report["components"] = piece.pieces;
        report["boundary_loops"] = part.topology->boundary_loops().size();
        outcome.scene = with_surface(outcome.scene, std::move(part));
    }
    outcome.report = std::make_shared<nlohmann::ordered_json>(std::move(report));
    return outcome;
}

}  // namespace

Operation crop_operation() {
    using enum ParameterType;
    return {
        .name = "crop",
        .usual_step = Step::Source,
        .allowed = {Step::Source},
        .summary = "keep a region of interest of image, mask and surface",
        .parameters =
            {{.name = "box",
              .type = List,
              .unit = "mm",
              .help = "opposite corners x0,y0,z0,x1,y1,z1 of the region, patient coordinates "
                      "(LPS); an image keeps its voxel grid, so it may extend farther",
              .meaning = Meaning::Box},
             {.name = "centre",
              .type = Point,
              .unit = "mm",
              .help = "centre of a ball (LPS); an image keeps the ball's bounding box",
              .meaning = Meaning::Place},
             {.name = "radius",
              .unit = "mm",
              .help = "radius of the ball",
              .minimum = 0.0,
              .above_minimum = true},
             {.name = "component",
              .type = Choice,
              .default_value = "largest",
              .help =
                  "which pieces of a cut surface are kept: the one with the largest area, or all",
              .choices = {"largest", "all"}}},
        .run = &crop,
        .example = {.placed = {"centre"},
                    .given = {{"radius", 3.0}},
                    .changed = {{"component", std::string("all")}}}};
}

}  // namespace vesselbench
