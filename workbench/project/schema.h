#pragma once

#include "workbench/project/database.h"

namespace vesselbench {

/// Creates the tables of an empty project in its start state, and the first entry of its record.
void make_tables(const Database& database);

/// True for a project of version 1, which has neither a lasting id nor a record.
[[nodiscard]] bool lacks_record(const Database& database);

/// Gives a project that lacks them an id and a record, whose first entry fixes what is found.
/// Inside the caller's transaction.
void begin_record(const Database& database);

/// \throw InvalidInput if the database is not a project, or of a newer version
void check_version(const Database& database);

/// \throw InvalidInput unless the database has exactly the tables of its version: no others, and no
/// triggers, views or indices
void check_tables(const Database& database);

}  // namespace vesselbench
