#include "workbench/session/stored_recipes.h"

#include "geometry/kernel/errors.h"
#include "workbench/project/database.h"

namespace vesselbench {

void store_recipes(const std::filesystem::path& project, const std::string& recipes) {
    const Database database(project, OpenMode::Write);
    database.prepare("INSERT OR REPLACE INTO meta VALUES('recipes', ?)").bind(0, recipes).step();
}

std::string stored_recipes(const std::filesystem::path& project) {
    try {
        const Database database(project, OpenMode::Read);
        Statement query = database.prepare("SELECT value FROM meta WHERE name = 'recipes'");
        return query.step() ? query.text(0) : "";
    } catch (const IoError&) {
        return "";
    } catch (const InvalidInput&) {
        return "";
    }
}

}  // namespace vesselbench
