#pragma once

#include "workbench/project/database.h"

namespace vesselbench {

/// Makes the tables of an empty project, at its start state.
void make_tables(const Database& database);

/// \throw InvalidInput if the database is no project, or one of a newer version
void check_version(const Database& database);

}  // namespace vesselbench
