#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "workbench/prepare/input.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/session/session.h"
#include "workbench/window/case/message.h"

namespace vesselbench {

/// What the user wants to open: a project, a surface, an image, a folder of slices or a case
/// folder; or a built-in phantom.
struct OpenRequest {
    std::filesystem::path path;
    std::string phantom;       ///< not empty: this phantom instead of the path
    bool beside_input = true;  ///< where a new project may go; else only the documents folder
    std::filesystem::path documents;     ///< the documents folder
    std::filesystem::path open_project;  ///< that is open now
    bool anew = false;  ///< a new project, even if one was made from this file before

    [[nodiscard]] std::string name() const;  ///< without folders
};

/// An opened case.
struct Opened {
    Session session;
    std::filesystem::path project;
    bool is_new = false;  ///< the project was made for this input
    /// Not empty: it was made at an earlier time from the file of this request.
    std::optional<OpenRequest> made_before;
    std::optional<Input> input;  ///< of a new project, with the case's own recipes
    std::vector<Message> remarks;
    PreparedPurposes prepared;
    bool is_open = false;  ///< this project is OpenRequest::open_project: it is to be shown
};

/// Opens a project, or that which was made from this file before, or makes one whose first edit
/// loads the input; takes as long as that takes.
/// \throw as Session::open, resolve_input and start_project
[[nodiscard]] Opened open_case(const OpenRequest& request, const SessionOptions& options,
                               const Progress& progress);

}  // namespace vesselbench
