#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "workbench/prepare/input.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/session/job.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What the user wants to open: a project, a surface, an image, a folder of slices or a case
/// folder; or a built-in phantom.
struct OpenRequest {
    std::filesystem::path path;
    std::string phantom;       ///< not empty: this phantom instead of the path
    bool beside_input = true;  ///< where a new project may go; else only the documents folder
    std::filesystem::path documents;  ///< the documents folder

    [[nodiscard]] std::string name() const;  ///< without folders
};

/// An opened case.
struct Opened {
    Session session;
    std::filesystem::path project;
    bool is_new = false;         ///< the project was made for this input
    std::optional<Input> input;  ///< of a new project, with the case's own recipes
    std::vector<std::string> remarks;
    PreparedPurposes prepared;
};

/// Opens a project, or makes one whose first edit loads the input; takes as long as that takes.
/// \throw as Session::open, resolve_input and start_project
[[nodiscard]] Opened open_case(const OpenRequest& request, const SessionOptions& options,
                               const Progress& progress);

/// open_case() on a thread of its own. The destructor cancels it.
class Opening {
public:
    /// \param notify called by the thread when it has ended
    /// \param after it waits for the end of this first: a case that is being closed holds its
    /// project
    Opening(OpenRequest request, SessionOptions options, std::function<void()> notify,
            std::shared_future<void> after = {});
    ~Opening();

    Opening(const Opening&) = delete;
    Opening& operator=(const Opening&) = delete;

    [[nodiscard]] const OpenRequest& request() const { return request_; }

    [[nodiscard]] const JobCore& job() const { return *job_; }

    void cancel() { job_->cancel(); }

    /// The result, once, after the job's end. \throw what opening threw
    [[nodiscard]] Opened take();

private:
    OpenRequest request_;
    std::shared_ptr<JobCore> job_ = std::make_shared<JobCore>();
    std::optional<Opened> result_;
    std::thread thread_;
};

}  // namespace vesselbench
