#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "workbench/case/edit_record.h"
#include "workbench/case/history.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// One edit of the current state, as the log shows it.
struct LogEntry {
    EditRecord edit;
    EditStatus status = EditStatus::Pending;
    std::string reason;                          ///< of a stale edit
    std::shared_ptr<const ResultRecord> result;  ///< of a done edit; else null
    /// Of a stale edit: the errors that the reason words; empty in projects of old versions.
    std::vector<Diagnostic> refusal = {};
};

/// One revision of an edit that some state contains, or contained.
struct PastEdit {
    EditRecord edit;
    std::shared_ptr<const ResultRecord> result;  ///< its newest that is not stale; else null
    /// Its first that is not stale: of the run in the one state that made the revision, whose
    /// figures later runs on other input do not change. Else null.
    std::shared_ptr<const ResultRecord> first;
};

/// The state of a session at one moment: an immutable value that any thread may hold and read while
/// the session continues.
struct Snapshot {
    std::shared_ptr<const History> history;  ///< the tree of states, without data; never null
    std::vector<LogEntry> log;               ///< the current state's edits, by step, then time
    /// Every revision of every edit of the whole history; never null.
    std::shared_ptr<const std::map<EditRef, PastEdit>> past;
    /// The scenes in memory, by variant, "" for the trunk. Absent: an edit before it is pending, or
    /// it has to be read through the session.
    std::map<std::string, Scene> scenes;
    std::string project;           ///< the file's name without its folder; empty: unsaved
    std::string read_only_reason;  ///< empty if the session may write
};

}  // namespace vesselbench
