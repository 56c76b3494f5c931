#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/pending_files.h"
#include "meshing/products/cfd_parameters.h"
#include "workbench/case/operation.h"
#include "workbench/case/scene.h"
#include "workbench/export/export_formats.h"

namespace vesselbench {

/// The flow of an OpenFOAM case: what was given of flow_parameters().
class FlowSettings {
public:
    FlowSettings() = default;
    /// \param stored of a project: stored() of an earlier one, or empty
    /// \throw InvalidInput if it is damaged
    explicit FlowSettings(const std::string& stored);

    /// \throw UsageError as checked_arguments
    explicit FlowSettings(Arguments given);

    [[nodiscard]] const Arguments& given() const { return given_; }

    /// Takes the "openfoam.parameter=value" texts out of a list; they replace what was given
    /// before. \throw UsageError as checked_arguments
    void take(std::vector<std::string>& texts);

    [[nodiscard]] CfdParameters parameters() const;

    /// For people, "flow=0.7 density=1050"; empty if nothing was given.
    [[nodiscard]] std::string text() const;

    /// JSON, to be kept in a project; empty if nothing was given.
    [[nodiscard]] std::string stored() const;

private:
    Arguments given_;
};

/// Names of the files that a purpose's model is exported as: the surface, and its own products.
/// \throw UsageError as find_purpose
[[nodiscard]] std::vector<std::string> product_names(const std::string& purpose);

/// \throw UsageError that lists the suffixes unless export_scene can write such a file
void check_export_name(const std::filesystem::path& file);

/// \throw UsageError that names the formats that do unless the one of this name shows a measure
void check_takes_colour(const std::filesystem::path& file);

/// \throw UsageError unless the format of this name is a page, which `option` is for
void check_takes_page(const std::filesystem::path& file, const std::string& option);

/// \throw IoError if a folder or file at this place must not be replaced by an export: it holds
/// files of others, or results of a flow
void check_export_place(const std::filesystem::path& file);

/// Writes one file or folder in the format of export_formats() that matches its name.
/// \throw UsageError that lists the suffixes if none matches, AlgorithmFailure if the scene has no
/// such content, IoError, Cancelled
void export_scene(PendingFiles& files, const std::filesystem::path& file, const Scene& scene,
                  const ExportOptions& options, const Progress& progress = {});

}  // namespace vesselbench
