#include <algorithm>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "gpu/png.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/commands/end_picture.h"
#include "workbench/operations/clip_opening/clipping.h"
#include "workbench/operations/clip_opening/clipping_record.h"
#include "workbench/prepare/before_cuts.h"

namespace vesselbench {

namespace {

/// Of the plan's openings: only the inlets are known before they are made.
std::vector<std::string> opening_names(const OpeningPlan& plan) {
    std::vector<std::string> names(plan.openings.size(), "outlet");
    for (const std::size_t inlet : plan.inlets) names[inlet] = "inlet";
    for (std::size_t i = 0; i < names.size(); ++i)
        if (plan.openings[i].patch) names[i] = plan.openings[i].patch->name;
    return names;
}

std::vector<EndRecord> by_number(const OpeningPlan& plan) {
    std::vector<EndRecord> ends = plan.ends;
    std::ranges::stable_sort(
        ends, {}, [](const EndRecord& end) { return std::pair(end.number == 0, end.number); });
    return ends;
}

void print_table(const OpeningPlan& plan, const std::vector<std::string>& names) {
    std::vector<std::vector<std::string>> rows = {
        {"end", "place [mm]", "diameter [mm]", "flow", "opening", "sac", "fate", "why"}};
    for (const EndRecord& end : by_number(plan)) {
        const auto share = [](double x) { return formatted(100.0 * x, "%.0f %%"); };
        rows.push_back({end.number > 0 ? std::to_string(end.number) : "-",
                        coordinates_argument(end.place), formatted(end.diameter),
                        end.verdict ? share(end.share()) : "-",
                        end.verdict ? share(end.verdict->odds.opening) : "-",
                        end.verdict ? share(end.verdict->odds.sac) : "-",
                        end.opening ? names[*end.opening] : to_string(end.fate), end.why});
    }
    std::cout << as_columns(rows);
}

}  // namespace

void list_ends(const EndsOptions& options, const Progress& progress) {
    const BeforeCuts before =
        before_cuts({options.input.input, options.input.mask, options.input.units}, "cfd",
                    with_ends(options.settings, options.ends), remark, progress.part(0.0, 0.7));
    OpeningPlan plan = planned_openings(before.scene, before.cutting, progress.part(0.7, 1.0));
    const std::vector<std::string> names = opening_names(plan);
    plan.ends = by_number(plan);
    if (!options.picture.empty()) {
        PendingFiles files;
        files.add_text(options.picture, png(picture_of_ends(surface_of(before.scene), plan)));
        files.commit();
    }
    if (options.json)
        std::cout << text_from_json(nlohmann::ordered_json({{"ends", ends_json(plan, names)}}), 2)
                  << "\n";
    else
        print_table(plan, names);
}

}  // namespace vesselbench
