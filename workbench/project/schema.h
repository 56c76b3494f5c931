#pragma once

#include "workbench/project/database.h"

namespace vesselbench {

/// Creates the tables of an empty project in its start state.
void make_tables(const Database& database);

/// \throw InvalidInput if the database is not a project, or of a newer version
void check_version(const Database& database);

}  // namespace vesselbench
