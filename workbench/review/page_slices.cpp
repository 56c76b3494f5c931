#include "workbench/review/page_slices.h"

#include <algorithm>
#include <cmath>

#include "workbench/case/point_json.h"
#include "workbench/review/page_bytes.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Columns or rows, from the first to the one after the last.
struct Range {
    int from = 0, to = 0;

    [[nodiscard]] int count() const { return to - from; }
};

/// Those within a reach of a place. \param middle, reach [pixels]
Range range_around(double middle, double reach, int count) {
    const auto from = static_cast<int>(std::floor(middle - reach));
    const auto to = static_cast<int>(std::ceil(middle + reach));
    return {std::clamp(from, 0, count), std::clamp(to, 0, count)};
}

/// Black outside the image.
char grey(float value, const GreyWindow& window) {
    if (!std::isfinite(value)) return 0;
    const double share = (value - window.level) / window.window + 0.5;
    return static_cast<char>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

PageSlices::PageSlices(const Image& image)
    : image_(image), grid_(slice_grid(image)), figures_(figures_of(image)) {}

Json PageSlices::add(const std::string& name, const Vec3& place, double reach) {
    Json slices = Json::array();
    for (const SlicePlane plane : kSlicePlanes) {
        Json slice = add("slice-" + name + "-" + axes_of(plane).key, plane, place, reach);
        if (!slice.is_null()) slices.push_back(std::move(slice));
    }
    return slices;
}

Json PageSlices::add(const std::string& blob, SlicePlane plane, const Vec3& place, double reach) {
    const bool labels = figures_.kind == ImageKind::Labels;
    const ImageSlice slice = slice_of(image_, grid_, plane, place[axes_of(plane).normal],
                                      labels ? Between::Nearest : Between::Linear);
    if (slice.columns == 0 || slice.rows == 0) return nullptr;
    const double wide = slice.across.norm() / slice.columns, high = slice.down.norm() / slice.rows;
    const Vec3 u = slice.across.normalized(), v = slice.down.normalized();
    const Range columns =
        range_around((place - slice.corner).dot(u) / wide, reach / wide, slice.columns);
    const Range rows = range_around((place - slice.corner).dot(v) / high, reach / high, slice.rows);
    if (columns.count() <= 0 || rows.count() <= 0) return nullptr;
    std::string pixels;
    for (int row = rows.from; row < rows.to; ++row)
        for (int column = columns.from; column < columns.to; ++column)
            pixels.push_back(
                grey(slice.values[static_cast<std::size_t>(row) * slice.columns + column],
                     figures_.automatic));
    blobs_[blob] = packed_text(pixels);
    const Vec3 first =
        slice.corner + (columns.from + 0.5) * wide * u + (rows.from + 0.5) * high * v;
    return {{"blob", blob},
            {"width", columns.count()},
            {"height", rows.count()},
            {"spacing", {wide, high}},
            {"origin", point_json(first)},
            {"u", point_json(u)},
            {"v", point_json(v)}};
}

}  // namespace vesselbench
