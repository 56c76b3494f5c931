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

/// Provides the measures of the surfaces that parameter sets produce from one original: the
/// interface through which searches and sensitivity analysis use smoothing or any other operation.
/// Not thread-safe.
class MeasureSource {
public:
    virtual ~MeasureSource() = default;

    /// Finds the measures not known yet. If interrupted, those found so far are kept.
    /// \throw Cancelled
    virtual void find(std::span<const ParameterSet> sets, const Progress& progress = {}) = 0;

    /// None if the set is left out. \throw as find
    [[nodiscard]] virtual std::optional<QualityMeasures> at(const ParameterSet& set,
                                                            const Progress& progress = {}) = 0;

    /// True if nothing is left to be found for a set, also if it is left out.
    [[nodiscard]] virtual bool knows(const ParameterSet& set) const = 0;

    /// True if every set takes a whole run, so that sets found one by one take no longer than all
    /// of them together.
    [[nodiscard]] virtual bool runs_each() const = 0;

    [[nodiscard]] virtual const QualityMeasures& original() const = 0;

    [[nodiscard]] virtual double mean_edge() const = 0;  ///< of the original [mm]

    /// The scale of graphs: the result of a very strong change. \throw as find
    [[nodiscard]] virtual const QualityMeasures& strong(const Progress& progress = {}) = 0;

    /// The recipe of that change: "50 iterations of laplace with lambda 1".
    [[nodiscard]] virtual std::string strong_name() const = 0;

    /// The work done so far.
    struct Work {
        std::size_t evaluations = 0;  ///< measurements of changed surfaces
        std::size_t runs = 0;         ///< changes started from the original surface
        std::size_t sweeps = 0;       ///< iterations over the surface
    };

    [[nodiscard]] virtual const Work& work() const = 0;
};

}  // namespace vesselbench
