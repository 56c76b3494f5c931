#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/messages.h"
#include "workbench/window/case/handbook.h"

namespace vesselbench {

void show_docs(const DocsOptions& options) {
    const std::filesystem::path page = handbook_page();
    if (page.empty())
        throw AlgorithmFailure(
            "the handbook is not there: a package has it, and in a clone of the sources, "
            "scripts/docs makes it with mkdocs");
    const std::string words = joined(options.words, " "), address = handbook_address(page, words);
    const bool shown = show_handbook(page, words);
    if (options.json)
        return void(
            std::cout << text_from_json(
                             {{"page", page.string()}, {"address", address}, {"shown", shown}}, 2)
                      << "\n");
    if (!shown) remark("there is no browser here; the handbook is at");
    std::cout << address << "\n";
}

}  // namespace vesselbench
