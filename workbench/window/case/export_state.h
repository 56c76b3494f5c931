#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "meshing/products/cfd_parameters.h"
#include "workbench/export/products.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What a project says about the export of a variant's model.
struct ExportState {
    std::string review;      ///< as review_words(); empty: nobody has reviewed it
    bool unsettled = false;  ///< it was reviewed, and not every edit is accepted
    std::string refusal;     ///< why the acceptance that the project requires is missing; or empty
    FlowSettings flow;       ///< of a solver's case, as the project keeps it
    std::optional<FlowSplit> split;  ///< of the vessel, while the flow gives none
};

/// \throw IoError, InvalidInput if the project cannot be read
[[nodiscard]] ExportState export_state(const Session& session, const std::filesystem::path& project,
                                       const std::string& variant);

}  // namespace vesselbench
