#pragma once

#include <utility>

#include "workbench/window/core/core.h"
#include "workbench/window/features/measures/measure_list.h"

namespace vesselbench {

/// Distances and diameters that are measured by clicks, and kept with the project.
class MeasuresFeature : public Feature {
public:
    explicit MeasuresFeature(Core& core) : core_(core), measures_(core.wake()) {}

    [[nodiscard]] MeasureList& measures() { return measures_; }

    /// What a measure that is made now is of. \param on Surface also for a preview
    [[nodiscard]] MeasuredModel measured_model(MeasuredOn on) const;

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return measures_.pending(); }

    void case_opened() override;

    void case_closed() override { end(); }

    void file_chosen(FileQuestion question, const std::filesystem::path& file) override;

private:
    void end();

    Core& core_;
    MeasureList measures_;
    /// The tool and the document's scene changes that the next click measures with.
    std::pair<ClickTool, int> measured_with_;
};

}  // namespace vesselbench
