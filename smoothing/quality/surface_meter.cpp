#include "smoothing/quality/surface_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <tbb/parallel_for.h>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"
#include "geometry/kernel/local_error.h"
#include "geometry/kernel/measure.h"
#include "smoothing/quality/ring_kernels.h"

namespace vesselbench {

namespace {

constexpr std::size_t kChunk = 512;  // places per partial sum: small, but not too many

constexpr std::size_t kSampleStep = 32;

Vec3 point_of(const PackRow& row) {
    return {row.values[0], row.values[1], row.values[2]};
}

/// The surface renumbered, so that its vertices are in the order of the states' places.
Surface in_order(std::shared_ptr<const Topology> topology,
                 std::shared_ptr<const Positions> original, std::span<const VertexId> order) {
    const std::size_t count = topology->vertex_count();
    if (original->size() != count || (!order.empty() && order.size() != count))
        throw InvalidInput("got " + std::to_string(original->size()) +
                           " positions and an order of " + std::to_string(order.size()) + " for " +
                           std::to_string(count) + " vertices");
    require_finite(*original);
    Surface surface{.topology = std::move(topology), .positions = std::move(original)};
    if (order.empty()) return surface;
    std::vector<VertexId> place(count);
    Positions positions(count);
    for (std::size_t p = 0; p < count; ++p) {
        place[order[p]] = static_cast<VertexId>(p);
        positions[p] = surface.points()[order[p]];
    }
    std::vector<Triangle> triangles;
    triangles.reserve(surface.triangle_count());
    for (const auto& [a, b, c] : surface.triangles())
        triangles.push_back({place[a], place[b], place[c]});
    return make_surface(std::move(positions), std::move(triangles));
}

}  // namespace

struct SurfaceMeter::Data {
    Surface surface;
    std::vector<PackRow> original;
    Fans fans;
    bool planes = false;
    std::vector<std::uint32_t> lanes;   ///< all places; within a chunk sorted by fan size
    std::vector<std::uint32_t> sample;  ///< every kSampleStep-th of them
    std::vector<double> interior;       ///< 1 where curvature counts
    std::vector<std::vector<VertexId>> loops;
    PackRow origin{};

    Data(Surface s, bool with_planes);

    [[nodiscard]] std::size_t chunks() const { return (original.size() + kChunk - 1) / kChunk; }

    /// What is kept of each place, by place; null: nothing.
    struct Kept {
        VertexId* followed = nullptr;  ///< references
        double* distances = nullptr;   ///< [mm]
    };

    /// Contribution of some places to the sums of the errors.
    void add_errors(Packs moved, std::span<const std::uint32_t> places, const VertexId* references,
                    const Kept& kept, QualityMeasures& sums) const;
    void add_curvatures(Packs moved, std::span<const std::uint32_t> places,
                        QualityMeasures& sums) const;

    [[nodiscard]] std::span<const std::uint32_t> places_of(std::size_t chunk) const {
        const std::size_t first = chunk * kChunk;
        return {lanes.data() + first, std::min(kChunk, lanes.size() - first)};
    }

    [[nodiscard]] double triangle_volume(Packs moved) const;
    [[nodiscard]] double area_scale() const;
    [[nodiscard]] double closing_volume(Packs moved) const;
    void find_angles(Packs moved, std::span<const std::uint32_t> places, double* angles) const;
    [[nodiscard]] double irregular_angle(Packs moved, std::uint32_t place) const;
    void add_irregular(Packs moved, std::uint32_t place, QualityMeasures& sums) const;
};

SurfaceMeter::Data::Data(Surface s, bool with_planes)
    : surface(std::move(s)), fans(make_fans(*surface.topology)), planes(with_planes) {
    const std::size_t count = surface.vertex_count();
    const Vec3 middle = bounds(surface).centre();
    origin = {{middle.x(), middle.y(), middle.z(), 0.0}};
    original.reserve(count);
    for (const Vec3& p : surface.points()) original.push_back({{p.x(), p.y(), p.z(), 0.0}});
    lanes.resize(count);
    std::iota(lanes.begin(), lanes.end(), 0U);
    const auto size = [&](std::uint32_t v) { return fans.offsets[v + 1] - fans.offsets[v]; };
    for (std::size_t first = 0; first < count; first += kChunk)
        std::stable_sort(
            lanes.begin() + static_cast<std::ptrdiff_t>(first),
            lanes.begin() + static_cast<std::ptrdiff_t>(std::min(count, first + kChunk)),
            [&](std::uint32_t a, std::uint32_t b) { return size(a) < size(b); });
    for (std::size_t i = kSampleStep / 2; i < count; i += kSampleStep) sample.push_back(lanes[i]);
    const auto& boundary = surface.topology->boundary_vertices();
    interior.resize(count);
    for (std::size_t v = 0; v < count; ++v)
        interior[v] = boundary[v] != 0 || fans.irregular[v] != 0 ? 0.0 : 1.0;
    loops = surface.topology->boundary_loops();
}

/// The area around all vertices over that around the sample, boundaries excluded as in curvatures.
double SurfaceMeter::Data::area_scale() const {
    std::vector<double> around(original.size(), 0.0);
    for (const Triangle& t : surface.triangles())
        for (const VertexId v : t) around[v] += triangle_area(surface.points(), t);
    double all = 0.0, sampled = 0.0;
    for (std::size_t v = 0; v < around.size(); ++v) all += interior[v] * around[v];
    for (const std::uint32_t v : sample) sampled += interior[v] * around[v];
    return sampled > 0.0 ? all / sampled : 1.0;
}

namespace {

/// The places of one chunk, their references and results.
struct ChunkErrors {
    std::array<VertexId, kChunk> references;
    std::array<double, kChunk> distances, planes;
    std::array<RingState, kChunk> states;
};

}  // namespace

void SurfaceMeter::Data::add_errors(Packs moved, std::span<const std::uint32_t> places,
                                    const VertexId* references, const Kept& kept,
                                    QualityMeasures& sums) const {
    const std::size_t count = places.size();
    ChunkErrors found;
    for (std::size_t i = 0; i < count; ++i) found.references[i] = references[places[i]];
    const auto search = [&](ChunkErrors& errors, const std::uint32_t* at, std::size_t many) {
        find_ring_distances(fans,
                            {original.data(), moved.data(), at, errors.references.data(), many},
                            {errors.distances.data(), planes ? errors.planes.data() : nullptr,
                             errors.states.data()});
    };
    search(found, places.data(), count);
    // Vertices that drift to another reference are searched again, four at a time, in their own
    // queue.
    ChunkErrors again;
    std::array<std::uint32_t, kChunk> again_places, again_index;
    std::size_t drifting = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (found.states[i] != RingState::Drifts && found.states[i] != RingState::Unknown) continue;
        found.references[i] = drifted_reference(*surface.topology, surface.points(),
                                                point_of(moved[places[i]]), found.references[i]);
        again_places[drifting] = places[i];
        again_index[drifting] = static_cast<std::uint32_t>(i);
        again.references[drifting++] = found.references[i];
    }
    search(again, again_places.data(), drifting);
    for (std::size_t i = 0; i < drifting; ++i) {
        found.distances[again_index[i]] = again.distances[i];
        if (planes) found.planes[again_index[i]] = again.planes[i];
        found.states[again_index[i]] = again.states[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = point_of(moved[places[i]]);
        if (found.states[i] != RingState::Known)
            found.distances[i] =
                local_error_at(*surface.topology, surface.points(), p, found.references[i]);
        if (found.states[i] == RingState::Unknown && planes)
            found.planes[i] = local_error_at(*surface.topology, surface.points(), p,
                                             found.references[i], LocalErrorForm::Thesis);
        sums.error += found.distances[i];
        if (planes) sums.error_thesis += found.planes[i];
        if (kept.followed != nullptr) kept.followed[places[i]] = found.references[i];
        if (kept.distances != nullptr) kept.distances[places[i]] = found.distances[i];
    }
}

void SurfaceMeter::Data::add_irregular(Packs moved, std::uint32_t place,
                                       QualityMeasures& sums) const {
    Vec3 flow = Vec3::Zero(), normal = Vec3::Zero();
    for (const TriangleId t : surface.topology->triangles_at().row(place)) {
        const Triangle& c = surface.triangles()[t];
        const std::uint32_t k = corner_of(c, place);
        const Vec3 v = point_of(moved[place]), e = point_of(moved[c[(k + 1) % 3]]) - v,
                   f = point_of(moved[c[(k + 2) % 3]]) - v;
        const Vec3 n = e.cross(f);
        normal += n;
        if (!(n.norm() > 0.0)) continue;
        flow -= ((f.dot(f) - e.dot(f)) * e + (e.dot(e) - e.dot(f)) * f) / n.norm();
    }
    if (surface.topology->boundary_vertices()[place] == 0) {
        sums.curvature_abs += 0.25 * flow.norm();
        if (normal.norm() > 0.0) sums.curvature += 0.25 * flow.dot(normal) / normal.norm();
    }
    sums.volume += (point_of(moved[place]) - point_of(origin)).dot(normal);
}

void SurfaceMeter::Data::add_curvatures(Packs moved, std::span<const std::uint32_t> places,
                                        QualityMeasures& sums) const {
    const CurvatureSums found =
        curvature_sums(fans, moved.data(), places.data(), places.size(), interior.data(), origin);
    sums.curvature += found.curvature;
    sums.curvature_abs += found.curvature_abs;
    sums.volume += found.volume;
    if (!fans.any_irregular) return;
    for (const std::uint32_t place : places)
        if (fans.irregular[place] != 0) add_irregular(moved, place, sums);
}

/// As normal_curvature of geometry/kernel/measure.h [rad].
double SurfaceMeter::Data::irregular_angle(Packs moved, std::uint32_t place) const {
    const Vec3 v = point_of(moved[place]);
    std::vector<Vec3> normals;
    Vec3 sum = Vec3::Zero();
    for (const TriangleId t : surface.topology->triangles_at().row(place)) {
        const Triangle& c = surface.triangles()[t];
        const std::uint32_t k = corner_of(c, place);
        const Vec3 e = point_of(moved[c[(k + 1) % 3]]) - v, f = point_of(moved[c[(k + 2) % 3]]) - v;
        const Vec3 normal = e.cross(f);
        if (!(normal.norm() > 0.0)) continue;
        normals.push_back(normal.normalized());
        sum += std::atan2(normal.norm(), e.dot(f)) * normals.back();
    }
    double largest = 0.0;
    if (sum.norm() <= kLeastNormal) return largest;
    for (const Vec3& n : normals)
        largest = std::max(largest, std::atan2(sum.cross(n).norm(), sum.dot(n)));
    return largest;
}

void SurfaceMeter::Data::find_angles(Packs moved, std::span<const std::uint32_t> places,
                                     double* angles) const {
    find_normal_angles(fans, moved.data(), places.data(), places.size(), angles);
    if (!fans.any_irregular) return;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (fans.irregular[places[i]] != 0) angles[i] = irregular_angle(moved, places[i]);
}

double SurfaceMeter::Data::triangle_volume(Packs moved) const {
    const auto triangles = surface.triangles();
    constexpr std::size_t kTriangles = 4096;
    std::vector<double> parts((triangles.size() + kTriangles - 1) / kTriangles);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
        const std::size_t first = part * kTriangles;
        parts[part] = six_volumes(
            moved.data(), triangles.subspan(first, std::min(kTriangles, triangles.size() - first)),
            origin);
    });
    return std::accumulate(parts.begin(), parts.end(), 0.0) / 6.0;
}

double SurfaceMeter::Data::closing_volume(Packs moved) const {
    double sum = 0.0;
    const Vec3 from = point_of(origin);
    for (const auto& loop : loops) {
        Vec3 centre = Vec3::Zero();
        for (const VertexId v : loop) centre += point_of(moved[v]) - from;
        centre /= static_cast<double>(loop.size());
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 a = point_of(moved[loop[i]]) - from,
                       b = point_of(moved[loop[(i + 1) % loop.size()]]) - from;
            sum += centre.dot(b.cross(a));
        }
    }
    return sum / 6.0;
}

SurfaceMeter::SurfaceMeter(std::shared_ptr<const Topology> topology,
                           std::shared_ptr<const Positions> original, bool planes,
                           std::span<const VertexId> order)
    : data_(std::make_unique<const Data>(in_order(std::move(topology), std::move(original), order),
                                         planes)),
      mean_edge_(mean_edge_length(data_->surface)) {
    const auto own = own_references();
    original_ = measure(data_->original, own);
    original_.error = original_.error_thesis = 0.0;
    sample_scale_ = data_->area_scale();
}

SurfaceMeter::~SurfaceMeter() = default;

std::vector<VertexId> SurfaceMeter::own_references() const {
    return vesselbench::own_references(*data_->surface.topology);
}

void SurfaceMeter::follow(Packs moved, std::vector<VertexId>& references) const {
    tbb::parallel_for(std::size_t{0}, data_->chunks(), [&](std::size_t chunk) {
        const std::size_t last = std::min(moved.size(), (chunk + 1) * kChunk);
        for (std::size_t p = chunk * kChunk; p < last; ++p)
            references[p] = drifted_reference(*data_->surface.topology, data_->surface.points(),
                                              point_of(moved[p]), references[p]);
    });
}

QualityMeasures SurfaceMeter::measured(Packs moved, const VertexId* references,
                                       VertexId* followed) const {
    std::vector<QualityMeasures> parts(data_->chunks());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t chunk) {
        data_->add_errors(moved, data_->places_of(chunk), references, {.followed = followed},
                          parts[chunk]);
        data_->add_curvatures(moved, data_->places_of(chunk), parts[chunk]);
    });
    QualityMeasures sums;
    for (const QualityMeasures& part : parts) {  // in order: the same bits every time
        sums.error += part.error;
        sums.error_thesis += part.error_thesis;
        sums.curvature += part.curvature;
        sums.curvature_abs += part.curvature_abs;
        sums.volume += part.volume;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, moved.size()));
    sums.error /= count;
    sums.error_thesis /= count;
    sums.volume = sums.volume / 18.0 + data_->closing_volume(moved);
    return sums;
}

QualityMeasures SurfaceMeter::sampled(Packs moved, VertexId* references) const {
    const std::vector<std::uint32_t>& places = data_->sample;
    QualityMeasures sums;
    for (std::size_t first = 0; first < places.size(); first += kChunk) {
        const std::span some(places.data() + first, std::min(kChunk, places.size() - first));
        data_->add_errors(moved, some, references, {.followed = references}, sums);
        data_->add_curvatures(moved, some, sums);
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, places.size()));
    sums.error /= count;
    sums.error_thesis /= count;
    return sums;
}

QualityMeasures SurfaceMeter::follow_and_estimate(Packs moved,
                                                  std::vector<VertexId>& references) const {
    QualityMeasures found = sampled(moved, references.data());
    found.curvature *= sample_scale_;
    found.curvature_abs *= sample_scale_;
    found.volume = data_->triangle_volume(moved) + data_->closing_volume(moved);
    return found;
}

QualityMeasures SurfaceMeter::follow_and_measure(Packs moved,
                                                 std::vector<VertexId>& references) const {
    return measured(moved, references.data(), references.data());
}

QualityMeasures SurfaceMeter::measure(Packs moved, const std::vector<VertexId>& references) const {
    return measured(moved, references.data(), nullptr);
}

SeenMeasures SurfaceMeter::measure_seen(Packs moved) const {
    SeenMeasures seen;
    seen.error.values.resize(moved.size());
    std::vector<double> angles(data_->chunks());
    const std::vector<VertexId> own = own_references();
    tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t chunk) {
        const auto places = data_->places_of(chunk);
        QualityMeasures sums;
        data_->add_errors(moved, places, own.data(), {.distances = seen.error.values.data()}, sums);
        std::array<double, kChunk> found;
        data_->find_angles(moved, places, found.data());
        angles[chunk] = std::accumulate(found.begin(), found.begin() + std::ssize(places), 0.0);
    });
    for (const double value : seen.error.values) {  // in order: the same bits every time
        seen.error.mean += value;
        seen.error.largest = std::max(seen.error.largest, value);
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, moved.size()));
    seen.error.mean /= count;
    seen.volume = data_->triangle_volume(moved) + data_->closing_volume(moved);
    seen.normal_curvature_deg =
        std::accumulate(angles.begin(), angles.end(), 0.0) * 180.0 / std::numbers::pi / count;
    return seen;
}

}  // namespace vesselbench
