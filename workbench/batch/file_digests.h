#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace vesselbench {

/// SHA-256 of files and folders. What has kept its path, size and time since an earlier batch is
/// not read again.
class FileDigests {
public:
    /// \param known json() of the earlier batch, for the same files in the same order; null: none
    explicit FileDigests(nlohmann::ordered_json known) : known_(std::move(known)) {}

    /// The digest of the next file; "missing" if it cannot be read.
    [[nodiscard]] std::string next(const std::filesystem::path& path);

    /// What was asked for, to be kept: a list of {"state", "sha256"}. Both are digests: the names
    /// of folders and files are those of patients.
    [[nodiscard]] const nlohmann::ordered_json& json() const { return asked_; }

private:
    nlohmann::ordered_json known_, asked_ = nlohmann::ordered_json::array();
};

}  // namespace vesselbench
