#include "workbench/batch/batch_case.h"

namespace vesselbench {

std::vector<std::string> prepare_arguments(const BatchCase& one, const std::string& purpose,
                                           const std::filesystem::path& out) {
    std::vector<std::string> arguments = {"prepare", one.input,    "--for", purpose,
                                          "--out",   out.string(), "--json"};
    for (const CaseValue& value : one.values) arguments.push_back(value.argument());
    return arguments;
}

}  // namespace vesselbench
