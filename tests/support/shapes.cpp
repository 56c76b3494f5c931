#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include <stdlib.h>

#include "tests/support/surface_facts.h"

namespace vesselbench::test {

namespace {

constexpr double kGolden = std::numbers::phi;

struct FolderGuard {
    std::vector<std::string> folders;

    ~FolderGuard() {
        std::error_code ignored;
        for (const auto& folder : folders) std::filesystem::remove_all(folder, ignored);
    }
};

void divide(Positions& points, std::vector<Triangle>& triangles) {
    std::map<std::pair<VertexId, VertexId>, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
        const auto [it, fresh] =
            middles.try_emplace(std::minmax(a, b), static_cast<VertexId>(points.size()));
        if (fresh) points.push_back((points[a] + points[b]).normalized());
        return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
        const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
}

struct TubeParts {
    Positions points;
    std::vector<Triangle> triangles;
};

TubeParts tube_wall(double radius, double length, int around, int along) {
    TubeParts tube;
    for (int k = 0; k <= along; ++k)
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / around;
            tube.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                     length * k / along);
        }
    const auto id = [&](int k, int i) { return static_cast<VertexId>(k * around + i % around); };
    for (int k = 0; k < along; ++k)
        for (int i = 0; i < around; ++i) {
            tube.triangles.push_back({id(k, i), id(k, i + 1), id(k + 1, i)});
            tube.triangles.push_back({id(k, i + 1), id(k + 1, i + 1), id(k + 1, i)});
        }
    return tube;
}

struct FineTube {
    Positions points;
    std::vector<Triangle> triangles;
    PatchLabels labels;

    void add(Triangle triangle, std::uint16_t label) {
        triangles.push_back(triangle);
        labels.push_back(label);
    }

    // `shift` turns the ring, in parts of its spacing.
    void add_ring(double radius, double z, int count, double shift) {
        for (int i = 0; i < count; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + shift) / count;
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
    }

    void add_wall(int row, int i, int around) {
        const auto id = [&](int k, int j) {
            return static_cast<VertexId>(k * around + j % around);
        };
        add({id(row, i), id(row, i + 1), id(row + 1, i)}, 0);
        add({id(row, i + 1), id(row + 1, i + 1), id(row + 1, i)}, 0);
    }

    // Rings of 6, 12, 18 ... vertices from the rim at `outer` inwards.
    void add_cap(VertexId outer, double radius, int around, double shift, bool faces_down) {
        const double z = points[outer].z(), turn = shift / around;
        const std::uint16_t label = faces_down ? 1 : 2;
        for (int n = around / 6; n > 0; --n) {
            const auto inner = static_cast<VertexId>(points.size());
            if (n > 1)
                add_ring(radius * (n - 1) * 6 / around, z, 6 * (n - 1), turn * 6 * (n - 1));
            else
                points.emplace_back(0, 0, z);
            for (int sector = 0; sector < 6; ++sector)
                add_sector(outer, inner, n, sector, {label, faces_down});
            outer = inner;
        }
    }

    struct Side {
        std::uint16_t label;
        bool faces_down;
    };

    void add_sector(VertexId outer, VertexId inner, int n, int sector, Side side) {
        const auto out = [&](int i) {
            return outer + static_cast<VertexId>((sector * n + i) % (6 * n));
        };
        const auto in = [&](int i) {
            return n == 1 ? inner
                          : inner + static_cast<VertexId>((sector * (n - 1) + i) % (6 * (n - 1)));
        };
        const auto put = [&](VertexId a, VertexId b, VertexId c) {
            if (side.faces_down) std::swap(b, c);
            add({a, b, c}, side.label);
        };
        for (int i = 0; i < n; ++i) put(out(i), out(i + 1), in(i));
        for (int i = 0; i + 1 < n; ++i) put(out(i + 1), in(i + 1), in(i));
    }
};

}  // namespace

Surface icosphere(double radius, int levels, const Vec3& centre) {
    const double g = kGolden;
    Positions points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Vec3& p : points) p.normalize();
    std::vector<Triangle> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) divide(points, triangles);
    for (Vec3& p : points) p = centre + radius * p;
    return make_surface(std::move(points), std::move(triangles));
}

Surface open_tube(double radius, double length, int around, int along) {
    TubeParts tube = tube_wall(radius, length, around, along);
    return make_surface(std::move(tube.points), std::move(tube.triangles));
}

Surface closed_tube(double radius, double length, int around, int along) {
    TubeParts tube = tube_wall(radius, length, around, along);
    PatchLabels labels(tube.triangles.size(), 0);
    const auto bottom = static_cast<VertexId>(tube.points.size());
    tube.points.emplace_back(0, 0, 0);
    tube.points.emplace_back(0, 0, length);
    for (int i = 0; i < around; ++i) {
        const auto a = static_cast<VertexId>(i), b = static_cast<VertexId>((i + 1) % around);
        const auto top = static_cast<VertexId>(along * around);
        tube.triangles.push_back({b, a, bottom});
        labels.push_back(1);
        tube.triangles.push_back({top + a, top + b, bottom + 1});
        labels.push_back(2);
    }
    return make_surface(
        std::move(tube.points), std::move(tube.triangles), std::move(labels),
        {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}, {"outlet_1", PatchKind::Outlet}});
}

Surface fine_tube(double radius, double length, int around) {
    const double edge = 2.0 * std::numbers::pi * radius / around;
    const int rows = std::max(1, static_cast<int>(std::lround(length / (edge * std::sqrt(0.75)))));
    FineTube tube;
    for (int k = 0; k <= rows; ++k) tube.add_ring(radius, length * k / rows, around, 0.5 * k);
    for (int k = 0; k < rows; ++k)
        for (int i = 0; i < around; ++i) tube.add_wall(k, i, around);
    tube.add_cap(0, radius, around, 0.0, true);
    tube.add_cap(static_cast<VertexId>(rows * around), radius, around, 0.5 * rows, false);
    return make_surface(
        std::move(tube.points), std::move(tube.triangles), std::move(tube.labels),
        {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}, {"outlet_1", PatchKind::Outlet}});
}

Surface cube(double edge) {
    Positions points;
    for (int i = 0; i < 8; ++i)
        points.emplace_back(edge * (i & 1), edge * (i >> 1 & 1), edge * (i >> 2));
    return make_surface(std::move(points), {{0, 2, 1},
                                            {1, 2, 3},
                                            {4, 5, 6},
                                            {5, 7, 6},
                                            {0, 1, 4},
                                            {1, 5, 4},
                                            {2, 6, 3},
                                            {3, 6, 7},
                                            {0, 4, 2},
                                            {2, 4, 6},
                                            {1, 3, 5},
                                            {3, 7, 5}});
}

Surface mapped(const Surface& surface, const std::function<Vec3(const Vec3&)>& map) {
    Positions moved = surface.points();
    for (Vec3& p : moved) p = map(p);
    return surface.with_positions(std::move(moved));
}

Surface sphere_shell(double radius, double thickness, int levels) {
    const Surface inner = icosphere(radius - thickness, levels);
    const Eigen::Matrix3d rotation = skew_rotation();
    const Surface turned = mapped(inner, [&](const Vec3& p) -> Vec3 { return rotation * p; });
    std::vector<Triangle> faces;
    for (const auto& [a, b, c] : inner.triangles()) faces.push_back({a, c, b});
    return merged(icosphere(radius, levels), make_surface(turned.points(), std::move(faces)));
}

Eigen::Matrix3d skew_rotation() {
    return Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
}

std::string temporary_folder() {
    static FolderGuard guard;
    std::string pattern = (std::filesystem::temp_directory_path() / "vesselbench-XXXXXX").string();
    const char* made = ::mkdtemp(pattern.data());
    if (made == nullptr) throw std::runtime_error("cannot make a temporary folder");
    guard.folders.emplace_back(made);
    return made;
}

void write_unitless(const Surface& surface, const std::string& path) {
    std::ofstream file(path);
    file << "OFF\n" << surface.vertex_count() << ' ' << surface.triangle_count() << " 0\n";
    for (const Vec3& p : surface.points()) file << p.transpose() << '\n';
    for (const auto& [a, b, c] : surface.triangles())
        file << "3 " << a << ' ' << b << ' ' << c << '\n';
}

}  // namespace vesselbench::test
