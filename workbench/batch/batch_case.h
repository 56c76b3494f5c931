#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vesselbench {

/// An option of `prepare` that a case may have for itself, as the command line declares it.
struct CaseOption {
    std::string name;         ///< "mask", without the dashes
    bool is_flag = false;     ///< it has no value
    bool repeatable = false;  ///< it may be given several times
    bool is_file = false;     ///< its values may be files, but see names_file()
};

/// A value of an option.
struct CaseValue {
    std::string option;  ///< name of the CaseOption
    std::string text;    ///< empty for flags
    bool is_file = false;
    bool is_flag = false;

    /// As an argument of the program. "=": a value may be empty, or begin with a dash.
    [[nodiscard]] std::string argument() const {
        return "--" + option + (is_flag ? "" : "=" + text);
    }
};

/// A case of a batch: a run of `prepare`.
struct BatchCase {
    std::string name;               ///< plain; its folder's
    std::string input;              ///< path, or the name of a bundled case
    std::vector<CaseValue> values;  ///< in the order of the options
    std::size_t line = 0;           ///< of the manifest; 0: found in a folder
};

/// The arguments of the program that prepare the case.
/// \param out folder of its results
[[nodiscard]] std::vector<std::string> prepare_arguments(const BatchCase& one,
                                                         const std::string& purpose,
                                                         const std::filesystem::path& out);

}  // namespace vesselbench
