#pragma once

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/image/slices.h"

namespace vesselbench {

/// Parts of an image's slices around places, for the review page, as grey values of 8 bits.
class PageSlices {
public:
    /// \param image not empty; must outlive this
    explicit PageSlices(const Image& image);

    /// The three planes through a place, each so far to every side [mm].
    /// \param name of their blobs, unlike others
    /// \return "slices" of an edit of the page
    nlohmann::ordered_json add(const std::string& name, const Vec3& place, double reach);

    /// The page's blobs by name, as packed_text().
    [[nodiscard]] const std::map<std::string, std::string>& blobs() const { return blobs_; }

private:
    [[nodiscard]] nlohmann::ordered_json add(const std::string& blob, SlicePlane plane,
                                             const Vec3& place, double reach);

    const Image& image_;
    SliceGrid grid_;
    ImageFigures figures_;
    std::map<std::string, std::string> blobs_;
};

}  // namespace vesselbench
