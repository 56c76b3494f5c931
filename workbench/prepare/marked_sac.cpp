#include "workbench/prepare/marked_sac.h"

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

Diagnostic not_measured(const std::exception& why) {
    return {.code = "sac-not-measured", .words = {{"reason", why.what()}}};
}

}  // namespace

std::optional<MarkedNeck> marked_neck(const std::vector<LogEntry>& edits) {
    std::optional<MarkedNeck> last;
    for (const LogEntry& entry : edits)
        if (entry.status == EditStatus::Done && entry.result)
            if (auto marked = marked_neck(entry.edit.operation, entry.result->resolved))
                last = std::move(marked);
    return last;
}

std::optional<RecordedNeck> recorded_neck(const std::vector<LogEntry>& edits) {
    const auto marked = marked_neck(edits);
    if (!marked) return std::nullopt;
    return RecordedNeck{.neck = marked->neck, .reach = marked->reach};
}

ModelSac measured_sac(const Surface& surface, const MarkedNeck& marked, Keys keys,
                      const Progress& progress) {
    ModelSac sac;
    try {
        sac.figures = sac_figures(surface, marked, keys, progress);
        if (sac.figures->in_doubt) sac.warning = neck_in_doubt(marked, sac.figures->measures);
    } catch (const AlgorithmFailure& failure) {
        sac.warning = not_measured(failure);
    } catch (const InvalidInput& failure) {
        sac.warning = not_measured(failure);
    }
    return sac;
}

}  // namespace vesselbench
