#include "geometry/kernel/measure.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/case/measure_json.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/marked_sac.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/project/project.h"
#include "workbench/session/session.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string numbers(const Json& list) {
    std::vector<std::string> texts;
    for (const Json& number : list) texts.push_back(formatted(number.get<double>(), "%.4g"));
    return joined(texts);
}

void add_rows(std::vector<std::vector<std::string>>& rows, const std::string& prefix,
              const Json& part) {
    for (const auto& [key, value] : part.items()) {
        if (value.is_object())
            add_rows(rows, prefix + key + " ", value);
        else if (!value.is_array())
            rows.push_back(
                {prefix + key, value.is_number_float() ? numbers({value}) : value.dump()});
    }
}

constexpr std::size_t kMostBins = 10000;

/// The vertices by their distance from the reference; the last bin holds the farthest.
Json histogram_json(const Surface& surface, const Surface& reference, double width) {
    std::vector<std::size_t> bins;
    for (const SurfacePoint& nearest : distance_to(reference).closest_points(surface.points())) {
        const double bin = std::floor(nearest.distance / width);
        if (bin >= static_cast<double>(kMostBins))
            throw UsageError("--histogram: " + formatted(width, "%g") + " mm makes more than " +
                             std::to_string(kMostBins) + " bins: give more");
        bins.resize(std::max(bins.size(), static_cast<std::size_t>(bin) + 1));
        ++bins[static_cast<std::size_t>(bin)];
    }
    return {{"width", width}, {"vertices", bins}};
}

void print_histogram(const Json& histogram) {
    const double width = histogram["width"];
    std::vector<std::vector<std::string>> rows = {{"distance from the reference [mm]", "vertices"}};
    for (std::size_t bin = 0; bin < histogram["vertices"].size(); ++bin)
        rows.push_back({formatted(static_cast<double>(bin) * width, "%.4g") + " to " +
                            formatted(static_cast<double>(bin + 1) * width, "%.4g"),
                        histogram["vertices"][bin].dump()});
    std::cout << "\n" << as_columns(rows) << "\n";
}

/// What is measured, and the sac of a project's model.
struct Subject {
    Surface surface;
    std::optional<ModelSac> sac;
    std::string unit_text;  ///< one sentence
};

Subject subject_in_project(const MeasureOptions& options, const Progress& progress) {
    Session session = Session::open(options.surface, {.find = find_operation});
    const std::string variant =
        variant_of(options.surface, options.variant, *session.snapshot()->history);
    Subject subject{.surface = surface_of(session.scene(variant, progress.part(0.0, 0.7))),
                    .sac = {},
                    .unit_text = "the model is that of " + variant};
    if (const auto marked = marked_neck(session.log(variant)))
        subject.sac = measured_sac(subject.surface, *marked, Keys::Plain, progress.part(0.7, 1.0));
    return subject;
}

Subject subject_of(const MeasureOptions& options, const Progress& progress) {
    if (is_project_file(options.surface)) return subject_in_project(options, progress);
    const std::string& units = options.units;
    return {
        .surface = read_foreign_surface(options.surface, units),
        .sac = {},
        .unit_text = "the file was read in " +
                     (units.empty() ? assumed_units(units) + " (--units cm or m reads it otherwise)"
                                    : units)};
}

void print_table(const Json& document, const std::string& unit_text) {
    std::vector<std::vector<std::string>> rows;
    add_rows(rows, "", document);
    rows.push_back({"bounds", numbers(document["bounds"])});
    std::cout << as_columns(rows) << "\n";
    rows = {{"patch", "kind", "area [mm2]", "diameter [mm]", "flatness [mm]", "centroid [mm]",
             "normal"}};
    for (const Json& patch : document["patches"])
        rows.push_back({patch["name"], patch["kind"], numbers({patch["area"]}),
                        numbers({patch["diameter"]}), numbers({patch["flatness"]}),
                        numbers(patch["centroid"]), numbers(patch["normal"])});
    std::cout << as_columns(rows) << "\nLengths in mm, areas in mm2, volumes in mm3; " << unit_text
              << ".\n";
}

}  // namespace

void measure_surface(const MeasureOptions& options, const Progress& progress) {
    if (options.histogram && options.reference.empty())
        throw UsageError("--histogram counts distances from a reference: give REFERENCE");
    if (options.histogram && !(*options.histogram > 0.0 && std::isfinite(*options.histogram)))
        throw UsageError("--histogram must be above 0 mm");
    const Subject subject = subject_of(options, progress);
    const Surface& surface = subject.surface;
    Json document = measure_json(measure(surface));
    if (subject.sac && subject.sac->warning) warn(worded_with_operation(*subject.sac->warning));
    if (subject.sac && subject.sac->figures) document["sac"] = subject.sac->figures->table;
    if (!options.reference.empty()) {
        const Surface reference = read_foreign_surface(options.reference, options.units);
        document["reference"] = reference_json(compare_with_reference(surface, reference));
        if (options.histogram)
            document["reference"]["histogram"] =
                histogram_json(surface, reference, *options.histogram);
    }
    if (options.json) {
        if (!is_project_file(options.surface))
            document["file_units"] = assumed_units(options.units);
        std::cout << text_from_json(document, 2) << "\n";
    } else {
        print_table(document, subject.unit_text);
        if (options.histogram) print_histogram(document["reference"]["histogram"]);
    }
}

}  // namespace vesselbench
