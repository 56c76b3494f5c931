#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "smoothing/quality/quality_measures.h"

namespace vesselbench {

/// Values of all parameters of a search.
using ParameterSet = std::vector<double>;

/// What knows, or finds, the measures of what parameter sets make of one surface: the door through
/// which searches and sensitivity analysis use smoothing, and any other operation. For one thread
/// at a time.
class MeasureSource {
public:
    virtual ~MeasureSource() = default;

    /// Finds what is not known yet. If it is interrupted, what was found by then stays known.
    /// \throw Cancelled
    virtual void find(std::span<const ParameterSet> sets, const Progress& progress = {}) = 0;

    /// None where the set is left out. \throw as find
    [[nodiscard]] virtual std::optional<QualityMeasures> at(const ParameterSet& set,
                                                            const Progress& progress = {}) = 0;

    [[nodiscard]] virtual const QualityMeasures& original() const = 0;

    [[nodiscard]] virtual double mean_edge() const = 0;  ///< of the original [mm]

    /// What graphs measure by: the result of a very strong change. \throw as find
    [[nodiscard]] virtual const QualityMeasures& strong(const Progress& progress = {}) = 0;

    /// How that change is made: "50 iterations of laplace with lambda 1".
    [[nodiscard]] virtual std::string strong_name() const = 0;

    /// What was done so far.
    struct Work {
        std::size_t evaluations = 0;  ///< measurements of changed surfaces
        std::size_t runs = 0;         ///< changes started from the original surface
        std::size_t sweeps = 0;       ///< iterations over the surface
    };

    [[nodiscard]] virtual const Work& work() const = 0;
};

}  // namespace vesselbench
