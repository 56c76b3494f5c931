#include "meshing/tetrahedra/tetgen_run.h"

#include <algorithm>
#include <optional>

#include <tetgen.h>

#include "meshing/tetrahedra/point_order.h"
#include "meshing/tetrahedra/tetgen_failure.h"
#include "meshing/tetrahedra/tetgen_guard.h"

namespace vesselbench {

namespace {

/// TetGen's refinement callback takes no context.
const TooLarge*& current_wish() {
    thread_local const TooLarge* wish = nullptr;
    return wish;
}

/// For as long as TetGen runs, however it ends.
struct Wish {
    explicit Wish(const TooLarge& wish) { current_wish() = wish ? &wish : nullptr; }

    ~Wish() { current_wish() = nullptr; }

    Wish(const Wish&) = delete;
    Wish& operator=(const Wish&) = delete;
};

bool unsuitable(REAL* a, REAL* b, REAL* c, REAL* d, REAL* /*metric*/, REAL /*volume*/) {
    const Vec3 pa(a[0], a[1], a[2]), pb(b[0], b[1], b[2]), pc(c[0], c[1], c[2]),
        pd(d[0], d[1], d[2]);
    const double volume = std::abs((pb - pa).cross(pc - pa).dot(pd - pa)) / 6.0;
    return (*current_wish())((pa + pb + pc + pd) / 4.0, volume);
}

void fill_input(const Surface& surface, tetgenio& input) {
    input.numberofpoints = static_cast<int>(surface.vertex_count());
    input.pointlist = new REAL[3 * surface.vertex_count()];
    for (std::size_t v = 0; v < surface.vertex_count(); ++v)
        for (int k = 0; k < 3; ++k) input.pointlist[3 * v + k] = surface.points()[v][k];
    input.numberoffacets = static_cast<int>(surface.triangle_count());
    input.facetlist = new tetgenio::facet[surface.triangle_count()];
    input.facetmarkerlist = new int[surface.triangle_count()];
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        tetgenio::facet& facet = input.facetlist[t];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        facet.polygonlist[0].numberofvertices = 3;
        facet.polygonlist[0].vertexlist = new int[3];
        for (int k = 0; k < 3; ++k)
            facet.polygonlist[0].vertexlist[k] = static_cast<int>(surface.triangles()[t][k]);
        input.facetmarkerlist[t] = static_cast<int>((*surface.patch_labels)[t]) + 1;
    }
}

std::vector<Tetrahedron> tetrahedra_of(const tetgenio& output, const Positions& points) {
    std::vector<Tetrahedron> tetrahedra(static_cast<std::size_t>(output.numberoftetrahedra));
    for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
        Tetrahedron& tet = tetrahedra[t];
        for (int k = 0; k < 4; ++k)
            tet[k] = static_cast<VertexId>(output.tetrahedronlist[t * output.numberofcorners + k]);
        const Vec3& a = points[tet[0]];
        const double six_fold =
            (points[tet[1]] - a).cross(points[tet[2]] - a).dot(points[tet[3]] - a);
        if (six_fold < 0.0) std::swap(tet[2], tet[3]);
    }
    return tetrahedra;
}

// The outward sides of all tetrahedra that consist of boundary vertices only, by their corners.
std::vector<std::pair<Triangle, Triangle>> sides_on(const std::vector<std::uint8_t>& on_boundary,
                                                    const std::vector<Tetrahedron>& tetrahedra) {
    std::vector<std::pair<Triangle, Triangle>> sides;
    for (const Tetrahedron& tet : tetrahedra)
        for (const Triangle& side : faces_of(tet)) {
            if (!(on_boundary[side[0]] && on_boundary[side[1]] && on_boundary[side[2]])) continue;
            Triangle key = side;
            std::sort(key.begin(), key.end());
            sides.emplace_back(key, side);
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

// The one cell's side with these corners, outward; empty if two cells share it, or none has it.
std::optional<Triangle> outer_side(const std::vector<std::pair<Triangle, Triangle>>& sides,
                                   Triangle key) {
    std::sort(key.begin(), key.end());
    const auto first = std::lower_bound(sides.begin(), sides.end(), std::pair{key, Triangle{}});
    if (first == sides.end() || first->first != key) return std::nullopt;
    if (first + 1 != sides.end() && (first + 1)->first == key) return std::nullopt;
    return first->second;
}

VolumeMesh mesh_of(const tetgenio& output, const Surface& surface) {
    VolumeMesh mesh;
    mesh.patches = surface.patches;
    mesh.points.resize(static_cast<std::size_t>(output.numberofpoints));
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
        mesh.points[v] =
            Vec3(output.pointlist[3 * v], output.pointlist[3 * v + 1], output.pointlist[3 * v + 2]);
    mesh.tetrahedra = tetrahedra_of(output, mesh.points);
    std::vector<Triangle> facets(static_cast<std::size_t>(output.numberoftrifaces));
    std::vector<std::uint8_t> on_boundary(mesh.points.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            facets[f][k] = static_cast<VertexId>(output.trifacelist[3 * f + k]);
            on_boundary[facets[f][k]] = 1;
        }
    const auto sides = sides_on(on_boundary, mesh.tetrahedra);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const auto side = outer_side(sides, facets[f]);
        if (!side) continue;
        mesh.boundary.push_back(*side);
        mesh.boundary_patches.push_back(
            static_cast<std::uint16_t>(std::max(1, output.trifacemarkerlist[f]) - 1));
    }
    return mesh;
}

}  // namespace

TetgenResult run_tetgen(const Surface& surface, const std::string& switches,
                        const TooLarge& too_large) {
    TetgenResult result;
    if (!tetgen_guard_is_linked()) return result;
    tetgenio input, output;
    fill_input(surface, input);
    const Wish wish(too_large);
    if (too_large) input.tetunsuitable = unsuitable;
    std::string text = switches + "Q";
    try {
        tetrahedralize(text.data(), &input, &output);
        result.mesh = in_space_order(mesh_of(output, surface));
    } catch (int code) {
        result.error_code = code;
        result.error = tetgen_error_text(code);
    }
    return result;
}

std::vector<TriangleId> tetgen_intersecting_facets(const Surface& surface) {
    tetgenio input, output;
    fill_input(surface, input);
    for (int t = 0; t < input.numberoffacets; ++t) input.facetmarkerlist[t] = t + 1;
    std::string text = "pdQ";
    try {
        tetrahedralize(text.data(), &input, &output);
    } catch (int) {
        return {};
    }
    std::vector<TriangleId> facets;
    for (int f = 0; f < output.numberoftrifaces; ++f)
        if (output.trifacemarkerlist != nullptr && output.trifacemarkerlist[f] > 0)
            facets.push_back(static_cast<TriangleId>(output.trifacemarkerlist[f] - 1));
    std::sort(facets.begin(), facets.end());
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
    return facets;
}

}  // namespace vesselbench
