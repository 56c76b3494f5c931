#include "geometry/formats/grid_cells.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// VTK's numbers of cell types.
constexpr std::uint8_t kFirstFlat = 5, kStrip = 6, kPolygon = 7, kPixel = 8, kQuad = 9,
                       kFirstSolid = 10, kVoxel = 11;
constexpr std::uint8_t kQuadraticEdge = 21, kQuadraticTriangle = 22, kQuadraticQuad = 23;

/// A type of flat or solid cell: how many of its corners are used, of which it may have more on its
/// edges, and its faces, outward.
struct CellType {
    std::uint8_t type = 0;
    std::size_t corners = 0, all = 0;
    std::vector<std::vector<std::size_t>> faces;
};

const std::vector<CellType>& cell_types() {
    static const std::vector<std::vector<std::size_t>> tetrahedron = {
        {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
    static const std::vector<std::vector<std::size_t>> hexahedron = {
        {0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
    static const std::vector<std::vector<std::size_t>> voxel = {
        {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    static const std::vector<std::vector<std::size_t>> wedge = {
        {0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
    static const std::vector<std::vector<std::size_t>> pyramid = {
        {0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    static const std::vector<CellType> types = {{kFirstFlat, 3, 3, {{0, 1, 2}}},
                                                {kPixel, 4, 4, {{0, 1, 3, 2}}},
                                                {kQuad, 4, 4, {{0, 1, 2, 3}}},
                                                {kQuadraticTriangle, 3, 6, {{0, 1, 2}}},
                                                {kQuadraticQuad, 4, 8, {{0, 1, 2, 3}}},
                                                {kFirstSolid, 4, 4, tetrahedron},
                                                {kVoxel, 8, 8, voxel},
                                                {12, 8, 8, hexahedron},
                                                {13, 6, 6, wedge},
                                                {14, 5, 5, pyramid},
                                                {24, 4, 10, tetrahedron},
                                                {25, 8, 20, hexahedron},
                                                {26, 6, 15, wedge},
                                                {27, 5, 13, pyramid}};
    return types;
}

bool is_solid(std::uint8_t type) {
    return type >= kFirstSolid && type != kQuadraticEdge && type != kQuadraticTriangle &&
           type != kQuadraticQuad;
}

/// Lines and lone points.
bool is_thin(std::uint8_t type) {
    return type < kFirstFlat || type == kQuadraticEdge;
}

using Face = std::vector<VertexId>;

Face sorted(Face face) {
    std::ranges::sort(face);
    return face;
}

class SurfaceReader {
public:
    SurfaceReader(const GridCells& cells, const std::string& file, RawSurface& raw)
        : cells_(cells), file_(file), raw_(raw) {}

    void read() {
        if (std::ranges::any_of(cells_.types, is_solid))
            add_outer_faces();
        else
            for (std::size_t cell = 0; cell < cells_.types.size(); ++cell)
                for (const Face& face : faces_of(cell)) add(face, region_of(cell));
        const auto thin = static_cast<std::size_t>(std::ranges::count_if(cells_.types, is_thin));
        if (thin > 0)
            raw_.notes.push_back(std::to_string(thin) + " lines or isolated points were ignored");
    }

private:
    [[nodiscard]] std::optional<int> region_of(std::size_t cell) const {
        return cell < cells_.regions.size() ? std::optional(cells_.regions[cell]) : std::nullopt;
    }

    [[nodiscard]] std::span<const VertexId> corners_of(std::size_t cell) const {
        return std::span(cells_.corners)
            .subspan(cells_.offsets[cell], cells_.offsets[cell + 1] - cells_.offsets[cell]);
    }

    [[noreturn]] void fail(std::size_t cell, const std::string& what) const {
        throw InvalidInput(file_ + ", cell " + std::to_string(cell) + " " + what);
    }

    [[nodiscard]] std::vector<Face> faces_of(std::size_t cell) const {
        const std::uint8_t type = cells_.types[cell];
        const auto corners = corners_of(cell);
        if (is_thin(type)) return {};
        if (type == kPolygon)
            return std::vector<Face>(corners.size() < 3 ? 0 : 1,
                                     Face(corners.begin(), corners.end()));
        if (type == kStrip) return strip(corners);
        const auto known = std::ranges::find(cell_types(), type, &CellType::type);
        if (known == cell_types().end())
            fail(cell, "has VTK's type " + std::to_string(type) +
                           ", which is not read: extract the grid's surface (in ParaView: Extract "
                           "Surface, Triangulate) and save it as .vtp");
        if (corners.size() != known->all)
            fail(cell, "has " + std::to_string(corners.size()) + " corners instead of " +
                           std::to_string(known->all) + ": the file is damaged");
        std::vector<Face> faces;
        for (const auto& order : known->faces) {
            Face& face = faces.emplace_back();
            for (const std::size_t k : order) face.push_back(corners[k]);
        }
        return faces;
    }

    static std::vector<Face> strip(std::span<const VertexId> corners) {
        std::vector<Face> faces;
        for (std::size_t k = 0; k + 2 < corners.size(); ++k) {
            const std::size_t odd = k % 2;  // every second triangle is reversed
            faces.push_back({corners[k], corners[k + 1 + odd], corners[k + 2 - odd]});
        }
        return faces;
    }

    /// Faces of one volume cell only, in the order of the cells. A flat cell there has the region.
    void add_outer_faces() {
        struct Known {
            std::size_t cells = 0;
            std::optional<int> region;
        };

        std::map<Face, Known> known;
        for (std::size_t cell = 0; cell < cells_.types.size(); ++cell)
            for (const Face& face : faces_of(cell)) {
                Known& its = known[sorted(face)];
                if (is_solid(cells_.types[cell]))
                    ++its.cells;
                else
                    its.region = region_of(cell);
            }
        std::size_t solids = 0;
        for (std::size_t cell = 0; cell < cells_.types.size(); ++cell) {
            if (!is_solid(cells_.types[cell])) continue;
            ++solids;
            for (const Face& face : faces_of(cell)) {
                const Known& its = known[sorted(face)];
                if (its.cells == 1) add(face, its.region ? its.region : region_of(cell));
            }
        }
        raw_.notes.push_back("of the grid's " + counted(solids, "volume cell") +
                             ", the outer surface was taken");
    }

    void add(const Face& face, std::optional<int> region) {
        append_polygon(raw_.positions, face, raw_.triangles);
        if (region) raw_.part_ids.resize(raw_.triangles.size(), *region);
    }

    const GridCells& cells_;
    const std::string& file_;
    RawSurface& raw_;
};

}  // namespace

void GridCells::add(std::uint8_t type, const std::vector<VertexId>& its_corners) {
    if (offsets.empty()) offsets.push_back(0);
    types.push_back(type);
    corners.insert(corners.end(), its_corners.begin(), its_corners.end());
    offsets.push_back(corners.size());
}

void append_grid_surface(const GridCells& cells, const std::string& file, RawSurface& raw) {
    SurfaceReader(cells, file, raw).read();
}

}  // namespace vesselbench
