#include "workbench/window/features/measures/measures_feature.h"

#include "workbench/report/measure_table.h"
#include "workbench/window/features/live/live_feature.h"

namespace vesselbench {

MeasuredModel MeasuresFeature::measured_model(MeasuredOn on) const {
    const Document& document = core_.document;
    const bool preview = document.previewed() || core_.get<LiveFeature>().live().shown();
    return {.on = preview && on == MeasuredOn::Surface ? MeasuredOn::Preview : on,
            .state = document.is_open() ? document.snapshot()->history->current() : 0,
            .variant = document.variant()};
}

/// A distance is not continued on another model, or after another tool.
bool MeasuresFeature::update() {
    const std::pair now(core_.view.tool, core_.document.scene_changes());
    if (std::exchange(measured_with_, now) != now) measures_.begin_next();
    return measures_.update();
}

void MeasuresFeature::end() {
    const std::string lost = measures_.close();
    if (!lost.empty())
        core_.document.tell(make_message(MessageKind::Error,
                                         "the last change of the measurements is lost: " + lost));
}

void MeasuresFeature::case_opened() {
    end();
    measures_.open(core_.document.project(), core_.document.snapshot()->read_only_reason);
}

void MeasuresFeature::file_chosen(FileQuestion question, const std::filesystem::path& file) {
    if (question == FileQuestion::Measures)
        core_.document.write_table(file, measures_csv(measures_.all()));
}

}  // namespace vesselbench
