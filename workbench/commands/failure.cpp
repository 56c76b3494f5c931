#include "workbench/commands/failure.h"

#include <iostream>

#include <nlohmann/json.hpp>

#include "workbench/case/diagnostic_json.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/console/messages.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json failure_json(const Failure& failure, const FailedCommand& command) {
    Json json = {{"error", failure.text}, {"code", failure.code}};
    if (failure.cancelled) json["cancelled"] = true;
    if (command.edit) json["edit"] = *command.edit;
    if (!command.refused.empty())
        json["diagnostics"] = Json::parse(command.refused);
    else if (!failure.diagnostics.empty())
        json["diagnostics"] = diagnostics_json(failure.diagnostics);
    return json;
}

}  // namespace

int report_failure(const Failure& failure, const FailedCommand& command) {
    complain(failure.text);
    if (command.json)  // a text may quote a file's name, which need not be UTF-8
        std::cout << text_from_json(failure_json(failure, command), 2) << "\n";
    return failure.code;
}

}  // namespace vesselbench
