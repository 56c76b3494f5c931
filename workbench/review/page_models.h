#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/review/page_choices.h"
#include "workbench/review/page_geometry.h"
#include "workbench/review/page_wall.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What a page shows of the image.
enum class PageImages : std::uint8_t {
    None,      ///< nothing
    Contours,  ///< nothing; the page cuts the surfaces
    Slices     ///< parts of three slices through the place of each edit
};

/// What is made besides the surfaces and their changes, which the queue needs.
struct PageContents {
    PageImages images = PageImages::Contours;
    bool thumbnails = true;
};

/// Of the queue alone.
inline constexpr PageContents kQueueOnly{.images = PageImages::None, .thumbnails = false};

/// What an edit did to the surface, for the review page.
struct PageEditModel {
    std::optional<std::size_t> before, after;  ///< states of the page's geometry; none: no surface
    nlohmann::ordered_json deviation;          ///< of `after` from `before`; null: none
    double largest = 0.0;                      ///< deviation [mm]
    std::optional<Vec3> place;                 ///< of it [mm]
    Vec3 outward = Vec3::Zero();               ///< unit normal of the surface there
    std::optional<double> radius;              ///< of the vessel there, before the edit [mm]
    std::optional<WallChange> wall;            ///< none: it has not moved
    std::vector<OtherChoice> others;           ///< than the operation's own
    std::optional<Bounds> changed;             ///< box of what moved or is new [mm]
    std::string thumbnail;                     ///< a PNG file's bytes; empty: none
    nlohmann::ordered_json slices = nlohmann::ordered_json::array();
};

/// The surfaces of a variant's edits as far as they have run.
struct PageModels {
    PageGeometry geometry;
    std::map<EditId, PageEditModel> edits;
    std::vector<std::pair<std::string, std::size_t>> neighbours;  ///< name, state
    std::map<std::string, std::string> slices;                    ///< blobs of the edits' slices
};

/// \param log of the variant, in order
/// \param find of operations
/// \throw what Session::result_scene() throws
[[nodiscard]] PageModels page_models(Session& session, const std::vector<LogEntry>& log,
                                     const OperationLookup& find, const PageContents& contents = {},
                                     Progress progress = {});

}  // namespace vesselbench
