#include "geometry/kernel/measure.h"

#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/measure_json.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console.h"
#include "workbench/operations/shared/foreign_surface.h"

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

void print_table(const Json& document, const std::string& units) {
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
    std::cout << as_columns(rows)
              << "\nLengths in mm, areas in mm2, volumes in mm3; the file was read in "
              << (units.empty() ? "mm (--units cm or m reads it otherwise)" : units) << ".\n";
}

}  // namespace

void measure_surface(const MeasureOptions& options) {
    const Surface surface = read_foreign_surface(options.surface, options.units);
    Json document = measure_json(measure(surface));
    if (!options.reference.empty())
        document["reference"] = reference_json(compare_with_reference(
            surface, read_foreign_surface(options.reference, options.units)));
    if (options.json)
        std::cout << document.dump(2) << "\n";
    else
        print_table(document, options.units);
}

}  // namespace vesselbench
