#include "meshing/products/inflow.h"

#include <algorithm>
#include <array>
#include <map>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

using Edge = std::pair<VertexId, VertexId>;

struct FlatMesh {
    Positions points;
    std::vector<Triangle> triangles;  // the four children of triangle i are 4 i ... 4 i + 3
};

FlatMesh compact(const Positions& positions, const std::vector<Triangle>& triangles) {
    FlatMesh mesh;
    std::map<VertexId, VertexId> names;
    for (Triangle triangle : triangles) {
        for (VertexId& v : triangle) {
            const auto [it, fresh] =
                names.try_emplace(v, static_cast<VertexId>(mesh.points.size()));
            if (fresh) mesh.points.push_back(positions[v]);
            v = it->second;
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

FlatMesh divided(const FlatMesh& mesh) {
    FlatMesh finer{mesh.points, {}};
    std::map<Edge, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
        const auto [it, fresh] =
            middles.try_emplace(std::minmax(a, b), static_cast<VertexId>(finer.points.size()));
        if (fresh) finer.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
        return it->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.triangles.insert(finer.triangles.end(),
                               {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return finer;
}

std::vector<std::uint8_t> rim_vertices(const FlatMesh& mesh) {
    std::map<Edge, int> uses;
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    std::vector<std::uint8_t> rim(mesh.points.size(), 0);
    for (const auto& [edge, count] : uses)
        if (count == 1) rim[edge.first] = rim[edge.second] = 1;
    return rim;
}

// Cotangent stiffness and lumped load of the inner vertices.
Eigen::VectorXd solve_poisson(const FlatMesh& mesh) {
    const auto rim = rim_vertices(mesh);
    if (std::find(rim.begin(), rim.end(), 1) == rim.end())
        throw InvalidInput("inflow: the inlet has no rim");
    const auto n = static_cast<Eigen::Index>(mesh.points.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
    for (const Triangle& t : mesh.triangles) {
        const double twice_area = area_normal(mesh.points, t).norm();
        if (twice_area <= 0.0) continue;
        for (int k = 0; k < 3; ++k) {
            const VertexId a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            if (rim[c] == 0) load[c] += twice_area / 6.0;
            const double weight =
                0.5 * (mesh.points[a] - mesh.points[c]).dot(mesh.points[b] - mesh.points[c]) /
                twice_area;
            if (rim[a] == 0) entries.emplace_back(a, a, weight);
            if (rim[b] == 0) entries.emplace_back(b, b, weight);
            if (rim[a] != 0 || rim[b] != 0) continue;
            entries.emplace_back(a, b, -weight);
            entries.emplace_back(b, a, -weight);
        }
    }
    for (Eigen::Index v = 0; v < n; ++v)
        if (rim[v] != 0) entries.emplace_back(v, v, 1.0);
    Eigen::SparseMatrix<double> stiffness(n, n);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(stiffness);
    return solver.solve(load);
}

}  // namespace

std::vector<double> developed_profile(const Positions& positions,
                                      const std::vector<Triangle>& triangles) {
    const FlatMesh fine = divided(divided(compact(positions, triangles)));
    const Eigen::VectorXd u = solve_poisson(fine);
    std::vector<double> flux(triangles.size(), 0.0);
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        const auto& [a, b, c] = fine.triangles[t];
        flux[t / 16] +=
            0.5 * area_normal(fine.points, fine.triangles[t]).norm() * (u[a] + u[b] + u[c]) / 3.0;
    }
    double total_flux = 0.0, total_area = 0.0;
    std::vector<double> areas(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        areas[t] = 0.5 * area_normal(positions, triangles[t]).norm();
        total_flux += flux[t];
        total_area += areas[t];
    }
    for (std::size_t t = 0; t < triangles.size(); ++t)
        flux[t] *= total_area / (total_flux * std::max(areas[t], 1e-300));
    return flux;
}

}  // namespace vesselbench
