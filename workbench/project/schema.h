#pragma once

#include "workbench/project/database.h"

namespace vesselbench {

/// Creates the tables of an empty project in its start state.
void make_tables(const Database& database);

/// \throw InvalidInput if the database is not a project, or of a newer version
void check_version(const Database& database);

/// \throw InvalidInput unless the database has exactly the tables of make_tables(): no others, and
/// no triggers, views or indices
void check_tables(const Database& database);

}  // namespace vesselbench
