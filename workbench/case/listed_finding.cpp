#include "workbench/case/listed_finding.h"

#include <nlohmann/json.hpp>

namespace vesselbench {

bool is_listed_finding(const nlohmann::ordered_json& finding) {
    const auto certainty = finding.find("certainty");
    return certainty == finding.end() || !certainty->is_number() ||
           certainty->get<double>() >= kListed;
}

}  // namespace vesselbench
