#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "gpu/png.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/operations/clip_opening/clipping.h"
#include "workbench/operations/clip_opening/clipping_record.h"
#include "workbench/operations/clip_opening/planned_ends.h"
#include "workbench/prepare/before_cuts.h"
#include "workbench/prepare/end_picture.h"

namespace vesselbench {

namespace {

void print_table(const OpeningPlan& plan, const std::vector<std::string>& names) {
    std::vector<std::vector<std::string>> rows = {
        {"end", "place [mm]", "diameter [mm]", "flow", "opening", "sac", "fate", "why"}};
    for (const EndRecord& end : plan.ends) {
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
    const BeforeCuts before = before_cuts({.input = options.input.input,
                                           .mask = options.input.mask,
                                           .units = options.input.units,
                                           .label = options.input.label,
                                           .mask_is = options.input.mask_is},
                                          "cfd", with_ends(options.settings, options.ends), remark,
                                          progress.part(0.0, 0.7));
    if (before.doubt) warn(worded(*before.doubt));
    OpeningPlan plan = planned_openings(before.scene, before.cutting, progress.part(0.7, 1.0));
    const std::vector<std::string> names = planned_names(plan);
    plan.ends = ends_by_number(plan);
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
