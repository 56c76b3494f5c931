// Phantoms with a known surface, for scripts/experiments_truth.py.
//
//   truth peers IMAGE LEVEL EDGE FOLDER   writes what two pipelines by hand make of the image:
//                                         sinc.vtp (VTK's flying edges, windowed sinc, CGAL's
//                                         isotropic remeshing to EDGE mm), taubin.vtp (the same
//                                         with Taubin's filter)
//   truth judge EXACT RESULT TRUTH.json   prints how near the result is to the exact surface
//
// and for scripts/experiments.py:
//
//   truth smooth WAY SURFACE IMAGE OUT    writes what VTK's windowed sinc (sinc) or InVesalius's
//                                         context-aware smoothing (context) make of the surface of
//                                         an image
//   truth distance EXACT RESULT [TRUTH.json]   prints how far the surfaces are apart

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/crop_surface.h"
#include "smoothing/filters/taubin.h"
#include "tests/bench/peer_meshes.h"
#include "tests/bench/reference_context_smoothing.h"
#include "tests/bench/reference_remeshing.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Surface surface_of(vtkPolyData& mesh) {
    Positions points(static_cast<std::size_t>(mesh.GetNumberOfPoints()));
    for (std::size_t v = 0; v < points.size(); ++v)
        mesh.GetPoint(static_cast<vtkIdType>(v), points[v].data());
    std::vector<Triangle> triangles;
    vtkCellArray& cells = *mesh.GetPolys();
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    for (cells.InitTraversal(); cells.GetNextCell(count, ids) != 0;)
        triangles.push_back({static_cast<VertexId>(ids[0]), static_cast<VertexId>(ids[1]),
                             static_cast<VertexId>(ids[2])});
    return make_surface(std::move(points), std::move(triangles));
}

/// The largest body of VTK's iso-surface, outward.
Surface flying_edges(const Image& image, double level) {
    vtkNew<vtkImageData> grid;
    grid->SetDimensions(image.size.data());
    vtkNew<vtkFloatArray> values;
    values->SetNumberOfValues(static_cast<vtkIdType>(image.voxel_count()));
    std::ranges::copy(*image.voxels, values->GetPointer(0));
    grid->GetPointData()->SetScalars(values);
    vtkNew<vtkFlyingEdges3D> edges;
    edges->SetInputData(grid);
    edges->SetValue(0, level);
    edges->ComputeNormalsOff();
    edges->ComputeScalarsOff();
    edges->Update();
    Surface surface = surface_of(*edges->GetOutput());
    Positions points = surface.points();
    for (Vec3& p : points) p = image.to_patient(p);
    surface = largest_piece(surface.with_positions(std::move(points))).surface;
    return volume(surface) < 0.0 ? flipped(surface) : surface;
}

Surface windowed_sinc(const Surface& surface) {
    vtkNew<vtkWindowedSincPolyDataFilter> filter;
    filter->SetInputData(bench::polydata(surface, VTK_DOUBLE));
    filter->SetNumberOfIterations(20);
    filter->SetPassBand(0.1);
    filter->NormalizeCoordinatesOn();
    filter->FeatureEdgeSmoothingOff();
    filter->BoundarySmoothingOff();
    filter->Update();
    return surface.with_positions(surface_of(*filter->GetOutput()).points());
}

void write_peers(const std::string& image, double level, double edge, const std::string& folder) {
    const Surface raw = flying_edges(read_image(image), level);
    write_surface(raw, folder + "/raw.vtp");
    const Surface sinc = windowed_sinc(raw);
    write_surface(bench::cgal_isotropic(sinc, edge).surface, folder + "/sinc.vtp");
    const Surface even = raw.with_positions(
        taubin(*raw.topology, raw.points(), {.lambda = 0.5}, {.iterations = 20}));
    write_surface(bench::cgal_isotropic(even, edge).surface, folder + "/taubin.vtp");
}

Surface context_aware(const Surface& surface, const Image& image) {
    const Eigen::Matrix3d steps = image.index_to_patient.topLeftCorner<3, 3>();
    const auto weights = bench::context_weights(surface, steps.colwise().normalized());
    return surface.with_positions(
        bench::context_smoothed(surface, weights, bench::ContextSmoothing{}.steps));
}

void write_smoothed(const std::string& way, const std::string& surface, const std::string& image,
                    const std::string& out) {
    const Surface raw = read_surface(surface, LengthUnit::Millimetre).surface;
    if (way != "sinc" && way != "context")
        throw InvalidInput("way '" + way + "' is unknown: use sinc or context");
    write_surface(way == "sinc" ? windowed_sinc(raw) : context_aware(raw, read_image(image)), out);
}

/// What the truth's file says beside the exact surface.
struct Truth {
    struct Ball {
        Vec3 centre;
        double radius;
    };

    std::vector<Ball> ends;                                 ///< that do not count
    std::optional<Ball> sac;                                ///< around it
    Vec3 neck = Vec3::Zero(), neck_normal = Vec3::UnitZ();  ///< plane, normal to the sac

    Truth() = default;

    explicit Truth(const Json& json) {
        const auto vec = [](const Json& n) { return Vec3(n.at(0), n.at(1), n.at(2)); };
        for (const Json& end : json.at("ends")) ends.push_back({vec(end), end.at(3)});
        if (!json.contains("sac")) return;
        sac = Ball{vec(json["sac"]), json["sac"].at(3)};
        neck = vec(json.at("neck"));
        neck_normal = vec(json.at("neck_normal")).normalized();
    }

    [[nodiscard]] bool counts(const Vec3& p) const {
        return std::ranges::none_of(
            ends, [&](const Ball& end) { return (p - end.centre).norm() < end.radius; });
    }
};

struct Sample {
    double distance = 0.0;  ///< [mm]
    double weight = 0.0;    ///< [mm^2]
};

/// Distances from the triangles' centroids, where the point on the exact surface counts.
void add_samples(const Surface& from, const Surface& to, bool from_exact, const Truth& truth,
                 std::vector<Sample>& samples) {
    Positions centroids;
    std::vector<double> areas;
    for (const Triangle& t : from.triangles()) {
        centroids.emplace_back((from.points()[t[0]] + from.points()[t[1]] + from.points()[t[2]]) /
                               3.0);
        areas.push_back(triangle_area(from.points(), t));
    }
    const auto nearest = SurfaceDistance(to).closest_points(centroids);
    for (std::size_t i = 0; i < nearest.size(); ++i)
        if (truth.counts(from_exact ? centroids[i] : nearest[i].point))
            samples.push_back({nearest[i].distance, areas[i]});
}

Json distances_json(const Surface& exact, const Surface& result, const Truth& truth) {
    std::vector<Sample> samples;
    add_samples(exact, result, true, truth, samples);
    add_samples(result, exact, false, truth, samples);
    std::ranges::sort(samples, {}, &Sample::distance);
    double area = 0.0, sum = 0.0, below = 0.0;
    for (const Sample& s : samples) area += s.weight;
    for (const Sample& s : samples) sum += s.weight * s.distance;
    double p95 = 0.0;
    for (const Sample& s : samples) {
        below += s.weight;
        p95 = s.distance;
        if (below >= 0.95 * area) break;
    }
    return {{"mean", sum / area}, {"p95", p95}, {"largest", samples.back().distance}};
}

/// Changes of a radius, summed.
struct RadiusChange {
    double sum = 0.0;       ///< [mm]
    double absolute = 0.0;  ///< [mm]
    int count = 0;

    void add(double change) {
        sum += change;
        absolute += std::abs(change);
        ++count;
    }

    [[nodiscard]] double bias() const { return sum / std::max(count, 1); }
};

/// Both surfaces and the truth of one judgement.
struct Judged {
    SurfaceDistance exact, result;
    const Truth& truth;
};

/// Mean change of the wall's distance within the section at p, by rays; none if few of them count.
/// A ray that leaves through another vessel, more than twice as far as the nearest wall, does not.
std::optional<double> section_change(const Judged& judged, const Vec3& p, const Vec3& along,
                                     double nearest) {
    constexpr int kRays = 32;
    const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
    double sum = 0.0;
    int count = 0;
    for (int r = 0; r < kRays; ++r) {
        const double angle = 2.0 * std::numbers::pi * r / kRays;
        const Vec3 ray = std::cos(angle) * u + std::sin(angle) * v;
        const auto wall = judged.exact.first_hit(p, ray, 2.0 * nearest);
        if (!wall || !judged.truth.counts(wall->point)) continue;
        const auto found = judged.result.first_hit(p, ray, 4.0 * nearest);
        if (!found) continue;
        sum += found->distance - wall->distance;
        ++count;
    }
    return count < kRays / 2 ? std::nullopt : std::optional(sum / count);
}

/// Change of the radius along the exact centerlines: of the distance to the nearest wall, and of
/// the mean distance within sections.
Json radius_json(const Surface& exact, const Surface& result, const Truth& truth) {
    const Judged judged{SurfaceDistance(exact), SurfaceDistance(result), truth};
    RadiusChange nearest, section;
    for (const CenterlineBranch& branch : compute_centerlines(exact).branches)
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            const Vec3& p = branch.points[i];
            const SurfacePoint wall = judged.exact.closest_point(p);
            if (!truth.counts(p) || !truth.counts(wall.point)) continue;
            nearest.add(-judged.result.signed_distance(p) - wall.distance);
            const std::size_t last = branch.points.size() - 1;
            const Vec3 chord = branch.points[std::min(i + 1, last)] - branch.points[i - (i > 0)];
            if (chord.norm() == 0.0) continue;
            if (const auto change = section_change(judged, p, chord.normalized(), wall.distance))
                section.add(*change);
        }
    return {{"bias", nearest.bias()},
            {"error", nearest.absolute / std::max(nearest.count, 1)},
            {"section_bias", section.bias()}};
}

/// Volume beyond the neck's plane and area in it, within the ball, by counting points.
Json sac_json(const Surface& surface, const Truth& truth) {
    constexpr int kAcross = 64;
    const auto& [centre, radius] = *truth.sac;
    const double step = 2.0 * radius / kAcross;
    const Vec3 n = truth.neck_normal, u = n.unitOrthogonal(), v = n.cross(u);
    const Vec3 foot = centre - (centre - truth.neck).dot(n) * n;
    Positions in_ball, in_plane;
    for (int i = 0; i < kAcross; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const Vec3 across = ((i + 0.5) * step - radius) * u + ((j + 0.5) * step - radius) * v;
            if ((foot + across - centre).norm() < radius) in_plane.emplace_back(foot + across);
            for (int k = 0; k < kAcross; ++k) {
                const Vec3 p = foot + across + (k + 0.5) * step * n;
                if ((p - centre).norm() < radius) in_ball.push_back(p);
            }
        }
    const SurfaceDistance to(surface);
    const auto inside = [&](const Positions& points) {
        const auto distances = to.signed_distances(points);
        return static_cast<double>(
            std::ranges::count_if(distances, [](double d) { return d < 0; }));
    };
    return {{"volume", inside(in_ball) * step * step * step},
            {"neck", inside(in_plane) * step * step}};
}

Truth truth_in(const std::string& file) {
    return Truth(Json::parse(file_content(file)));
}

void print_distances(const std::string& exact_file, const std::string& result_file,
                     const Truth& truth) {
    const Surface exact = read_surface(exact_file, LengthUnit::Millimetre).surface;
    const Surface result = read_surface(result_file, LengthUnit::Millimetre).surface;
    std::puts(distances_json(exact, result, truth).dump(2).c_str());
}

void judge(const std::string& exact_file, const std::string& result_file,
           const std::string& truth_file) {
    const Surface exact = read_surface(exact_file, LengthUnit::Millimetre).surface;
    const Surface result = read_surface(result_file, LengthUnit::Millimetre).surface;
    const Truth truth = truth_in(truth_file);
    Json found = {{"distance", distances_json(exact, result, truth)},
                  {"radius", radius_json(exact, result, truth)},
                  {"edge", mean_edge_length(result)}};
    if (truth.sac)
        found["sac"] = {{"exact", sac_json(exact, truth)}, {"result", sac_json(result, truth)}};
    std::puts(found.dump(2).c_str());
}

/// False if the words are none of the commands above.
bool obey(const std::vector<std::string>& words) {
    const std::string command = words.empty() ? "" : words[0];
    if (command == "peers" && words.size() == 5)
        write_peers(words[1], std::stod(words[2]), std::stod(words[3]), words[4]);
    else if (command == "judge" && words.size() == 4)
        judge(words[1], words[2], words[3]);
    else if (command == "smooth" && words.size() == 5)
        write_smoothed(words[1], words[2], words[3], words[4]);
    else if (command == "distance" && (words.size() == 3 || words.size() == 4))
        print_distances(words[1], words[2], words.size() == 4 ? truth_in(words[3]) : Truth());
    else
        return false;
    return true;
}

}  // namespace

}  // namespace vesselbench

int main(int argc, char** argv) {
    try {
        if (vesselbench::obey({argv + 1, argv + argc})) return 0;
        std::fputs(
            "truth peers IMAGE LEVEL EDGE FOLDER | judge EXACT RESULT TRUTH.json | smooth "
            "sinc|context SURFACE IMAGE OUT | distance EXACT RESULT [TRUTH.json]\n",
            stderr);
        return 2;
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
}
