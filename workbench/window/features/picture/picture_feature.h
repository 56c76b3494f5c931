#pragma once

#include <filesystem>
#include <utility>

#include "workbench/window/core/core.h"

namespace vesselbench {

/// Pictures of the view as files.
class PictureFeature : public Feature {
public:
    /// The file that a picture of the view was asked to be saved as; once.
    [[nodiscard]] std::filesystem::path take_file() { return std::exchange(file_, {}); }

    [[nodiscard]] bool pending() const override { return !file_.empty(); }

    void case_closed() override { file_.clear(); }

    void file_chosen(FileQuestion question, const std::filesystem::path& file) override {
        if (question == FileQuestion::Picture) file_ = file;
    }

private:
    std::filesystem::path file_;
};

}  // namespace vesselbench
