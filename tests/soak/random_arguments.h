#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/forest/dice.h"
#include "workbench/case/operation.h"

namespace vesselbench::soak {

/// Small files for the operations that load: surfaces open and closed, an image, its mask.
class SmallFiles {
public:
    /// Writes them into a new folder; keeps those that are there.
    explicit SmallFiles(std::filesystem::path folder);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

    /// A file that the operation may load with this parameter.
    [[nodiscard]] std::string one_for(const Operation& operation, const std::string& parameter,
                                      forest::Dice& dice) const;

private:
    std::filesystem::path folder_;
};

/// Values for an operation's parameters: each of its type, in its range and of its meaning in the
/// scene; required ones always, others sometimes, those that need others with them. Rarely the ends
/// of a range, and names and places that are nowhere.
[[nodiscard]] Arguments random_arguments(const Operation& operation, const Scene& scene,
                                         const SmallFiles& files, forest::Dice& dice);

}  // namespace vesselbench::soak
