#pragma once

#include <string>
#include <vector>

namespace vesselbench {

/// One period of a flow, linear between its samples.
struct Waveform {
    std::vector<double> times;  ///< [s], ascending from 0 to the period
    std::vector<double> flows;  ///< [cm^3/s], as many; the last equals the first
    bool synthetic = false;     ///< made by synthetic_waveform(), not measured

    [[nodiscard]] double period() const { return times.back(); }  ///< [s]

    [[nodiscard]] double mean() const;  ///< over the period [cm^3/s]
};

/// A pulsatile curve that is of no measurement: a period of 1 s, and
/// Q(t) = mean (1 + 0.5 cos(w t - 1.2) + 0.25 cos(2 w t - 2.4) + 0.1 cos(3 w t - 3.6)), w = 2 pi /
/// s, at 100 equal steps. It flows forward at all times. \param mean [cm^3/s]
[[nodiscard]] Waveform synthetic_waveform(double mean);

/// Reads rows of a time [s] and a flow [cm^3/s], by commas or spaces; lines that begin with # are
/// skipped. The first time becomes 0.
/// \param name of the file, for errors
/// \throw UsageError if a row is not two numbers, there are fewer than 3 or more than 1000 rows,
/// times do not increase, the last flow differs from the first by more than 1 % of the largest, or
/// the mean is not above 0
[[nodiscard]] Waveform waveform_from_text(const std::string& text, const std::string& name);

}  // namespace vesselbench
