// Prints Tables 5.6 and 5.7 of the thesis with our figures, as Markdown, for
// scripts/experiments.py.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "geometry/formats/image_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/cut_ends.h"
#include "smoothing/context/stack_orientation.h"
#include "smoothing/filters/laplace.h"
#include "tests/support/paths.h"
#include "tests/support/stack_phantoms.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

void print_error(const Surface& surface, const Eigen::Matrix3d& turn) {
    const auto found = estimate_stack_orientation(turned(surface, turn));
    std::printf(" %.3f%s |", degrees_between(found.direction, turn.col(2)),
                found.certain ? "" : " (uncertain)");
}

constexpr const char* kOrgans =
    "vessel, mask | muscle, mask | liver, mask | vessel, intensities | muscle, intensities | "
    "liver, intensities";

std::array<Surface, 6> organs() {
    return {of_mask(vessel_in_slices()),
            of_mask(muscle_in_slices()),
            of_mask(organ_in_slices()),
            of_masked_intensities(vessel_in_slices()),
            of_masked_intensities(muscle_in_slices()),
            of_masked_intensities(organ_in_slices())};
}

Eigen::Matrix3d turned_by(int degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

void print_organs() {
    const std::array<Surface, 6> surfaces = organs();
    std::printf("| rotation | %s |\n|---|---|---|---|---|---|---|\n", kOrgans);
    for (const auto& [axis, name] : {std::pair{Vec3(1, 0, 0), "x"}, std::pair{Vec3(0, 1, 0), "y"}})
        for (int angle = 0; angle <= 90; angle += 30) {
            std::printf("| %s %d deg |", name, angle);
            for (const Surface& surface : surfaces) print_error(surface, turned_by(angle, axis));
            std::printf("\n");
        }
}

/// Smoothing takes the voxels' edges and planes from a surface.
void print_smoothed_organs() {
    const std::array<Surface, 6> surfaces = organs();
    std::printf("| Laplace iterations before | %s |\n|---|---|---|---|---|---|---|\n", kOrgans);
    for (const int iterations : {1, 2, 5, 10, 20}) {
        std::printf("| %d |", iterations);
        for (const Surface& surface : surfaces) {
            Positions moved =
                laplace(*surface.topology, surface.points(), {}, {.iterations = iterations});
            print_error(surface.with_positions(std::move(moved)), turned_by(30, Vec3(1, 0, 0)));
        }
        std::printf("\n");
    }
}

struct Outcome {
    double share = 0.0, flat = 0.0, error = 0.0;
    bool certain = false;
};

/// \param noise of the contrast
Outcome outcome_of(std::uint64_t seed, double noise) {
    CutSphere cut = cut_sphere(seed);
    auto& imaging = cut.description.imaging;
    imaging.noise = noise * (imaging.inside - imaging.outside);
    const Surface surface = imaged(cut.description);
    const auto found = estimate_stack_orientation(turned(surface, cut.rotation));
    return {cut.share, 100.0 * share_of_flat_faces(surface),
            degrees_between(found.direction, cut.rotation.col(2)), found.certain};
}

void print_row(const char* name, const std::vector<Outcome>& group) {
    double flat = 0.0, worst = 0.0;
    std::vector<double> errors;
    for (const Outcome& o : group) {
        flat += o.flat / static_cast<double>(group.size());
        errors.push_back(o.error);
        if (o.certain) worst = std::max(worst, o.error);
    }
    std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2),
                     errors.end());
    const auto certain =
        std::count_if(group.begin(), group.end(), [](const Outcome& o) { return o.certain; });
    std::printf("| %s | %zu | %.2f | %.3f | %ld | %.3f |\n", name, group.size(), flat,
                errors[errors.size() / 2], static_cast<long>(certain), worst);
}

std::vector<Outcome> outcomes_of(double noise) {
    constexpr std::size_t kSpheres = 400;
    std::vector<Outcome> outcomes(kSpheres);
    tbb::parallel_for(std::size_t{0}, kSpheres,
                      [&](std::size_t i) { outcomes[i] = outcome_of(i, noise); });
    return outcomes;
}

void print_spheres() {
    const std::vector<Outcome> outcomes = outcomes_of(0.0);
    std::map<double, std::vector<Outcome>> by_share;
    std::vector<Outcome> flat;
    for (const Outcome& o : outcomes) {
        by_share[o.share].push_back(o);
        if (o.flat >= 1.0) flat.push_back(o);
    }
    std::printf(
        "| removed of the topmost slice | spheres | flat faces, mean [%%] | median error [deg] | "
        "called certain | largest error of these [deg] |\n|---|---|---|---|---|---|\n");
    for (const auto& [share, group] : by_share)
        print_row(share == 1.0 ? "all" : ("1/" + std::to_string(std::lround(1.0 / share))).c_str(),
                  group);
    print_row("any, 1 % flat faces or more", flat);
    print_row("any, noise of 2 %", outcomes_of(0.02));
    print_row("any, noise of 5 %", outcomes_of(0.05));
}

// The thesis's method, word for word (5.3.1), for comparison: every face is a sample.

constexpr double kRadius = 0.1;             // of the density and the clusters
constexpr double kFlat = 0.05;              // theta below which a face is flat
constexpr std::size_t kMostSamples = 6000;  // every n-th face beyond: all pairs are compared

std::vector<Vec3> face_samples(const Surface& surface) {
    std::vector<Vec3> samples;
    const std::size_t step = surface.triangle_count() / kMostSamples + 1;
    for (std::size_t t = 0; t < surface.triangle_count(); t += step) {
        const Vec3 normal = area_normal(surface.points(), surface.triangles()[t]);
        if (normal.norm() > 0.0) samples.emplace_back(normal.normalized());
    }
    return samples;
}

/// The samples of the dense part, joined step by step to clusters; the mean of each.
std::vector<Vec3> cluster_means(const std::vector<Vec3>& samples) {
    std::vector<double> density(samples.size(), 0.0);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        for (const Vec3& other : samples) density[i] += (samples[i] - other).norm() < kRadius;
    });
    double mean = 0.0;
    for (const double d : density) mean += d / static_cast<double>(density.size());
    const double threshold = 0.5 * (mean + *std::ranges::max_element(density));
    std::vector<Vec3> rest, means;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (density[i] >= threshold) rest.push_back(samples[i]);
    while (!rest.empty()) {
        std::vector<Vec3> cluster = {rest.back()};
        rest.pop_back();
        Vec3 sum = Vec3::Zero();
        for (std::size_t m = 0; m < cluster.size(); ++m) {
            const Vec3 member = cluster[m];
            sum += member;
            const auto near = std::partition(rest.begin(), rest.end(), [&](const Vec3& other) {
                return (member - other).norm() >= kRadius;
            });
            cluster.insert(cluster.end(), near, rest.end());
            rest.erase(near, rest.end());
        }
        means.emplace_back(sum.normalized());
    }
    return means;
}

Vec3 literal_axis(const Surface& surface) {
    const std::vector<Vec3> samples = face_samples(surface);
    Vec3 best = Vec3::UnitZ();
    std::ptrdiff_t most = -1;
    for (const Vec3& mean : cluster_means(samples)) {
        const auto flat = std::ranges::count_if(
            samples, [&](const Vec3& n) { return 1.0 - std::abs(n.dot(mean)) < kFlat; });  // (5.3)
        if (flat > most) best = mean;
        most = std::max<std::ptrdiff_t>(most, flat);
    }
    return best;
}

/// A bundled image; empty if the folder is absent.
std::string image_file(const std::string& name) {
    const std::string path = source_folder() + "/../shared/data/images/" + name;
    return std::filesystem::exists(path) ? path : "";
}

/// A surface of a patient's image.
struct RealMask {
    std::string name;
    Sampling sampling;
    Surface surface;
};

Image inside_of(Image image, bool below, double limit) {
    std::vector<float> inside;
    inside.reserve(image.voxels->size());
    for (const float value : *image.voxels)
        inside.push_back((value < limit) == below ? 1.0F : 0.0F);
    image.voxels = std::make_shared<const std::vector<float>>(std::move(inside));
    return image;
}

void add_mask(std::vector<RealMask>& masks, const std::string& name, const Image& image,
              const std::optional<Image>& mask, const ExtractionParameters& how) {
    constexpr std::size_t kSmall = 1500;  // faces of parts that hardly show a shape
    try {
        Extraction found = extract_surface(image, mask, how);
        if (found.surface.triangle_count() < kSmall) return;
        masks.push_back({name, found.sampling, std::move(found.surface)});
    } catch (const InvalidInput&) {
        // An organ that is not brighter than its surroundings has no intensities of its own.
    }
}

/// Label by label, and intensities inside each if there are any.
void add_labels(std::vector<RealMask>& masks, const std::string& file, const std::string& name,
                const std::string& intensities = "") {
    const std::string path = image_file(file);
    if (path.empty()) return;
    const Image labels = read_image(path);
    std::optional<Image> image;
    if (!intensities.empty()) image = read_image(image_file(intensities));
    for (const int label : labels_of(labels)) {
        const std::string one = name + " " + std::to_string(label);
        add_mask(masks, one + ", mask", labels, {},
                 {.method = ExtractionMethod::Labels, .labels = {label}, .with_topology = false});
        if (!image) continue;
        add_mask(masks, one + ", intensities", *image, labels,
                 {.method = ExtractionMethod::Masked, .labels = {label}, .with_topology = false});
    }
}

std::vector<RealMask> real_masks() {
    std::vector<RealMask> masks;
    const std::string aorta = image_file("vmtk_aorta.mha"),
                      tof = image_file("niivue_tof_mra.nii.gz");
    if (!aorta.empty()) {
        const Image inside =
            inside_of(read_image(image_file("vmtk_aorta_final_levelset.mha")), true, 0.0);
        add_mask(masks, "vmtk aorta, mask", inside, {}, {.method = ExtractionMethod::Labels});
        add_mask(masks, "vmtk aorta, intensities", read_image(aorta), inside,
                 {.method = ExtractionMethod::Masked, .threshold = 700.0});
    }
    if (!tof.empty()) {
        const Image image = read_image(tof);
        add_mask(masks, "TOF vessels, intensities", image, inside_of(image, false, 80.0),
                 {.method = ExtractionMethod::Masked, .threshold = 60.0, .dilation = 1});
    }
    add_labels(masks, "topcow_mr_roi_003_labels.nii.gz", "TopCoW MR");
    add_labels(masks, "topcow_ct_roi_023_labels.nii.gz", "TopCoW CT");
    add_labels(masks, "totalseg_aorta_true_false_lumen.nii.gz", "aorta lumen");
    add_labels(masks, "totalseg_example_labels_117.nii.gz", "TotalSegmentator",
               "totalseg_example_ct_sm.nii.gz");
    return masks;
}

Surface without_caps(const Surface& surface, const std::vector<Cap>& caps) {
    std::vector<std::uint8_t> gone(surface.triangle_count());
    for (const Cap& cap : caps)
        for (const TriangleId t : cap.triangles) gone[t] = 1;
    std::vector<Triangle> left;
    for (TriangleId t = 0; t < gone.size(); ++t)
        if (gone[t] == 0) left.push_back(surface.triangles()[t]);
    return make_surface(surface.points(), std::move(left));
}

/// How the estimates of one method came out.
struct Tally {
    int all = 0, certain = 0, near = 0, wrong = 0;  ///< near: within 5 degrees, whatever is claimed
    double worst = 0.0;                             ///< of the certain ones [deg]

    void add(double error, bool is_certain) {
        constexpr double kNear = 5.0;
        ++all;
        near += error <= kNear ? 1 : 0;
        if (!is_certain) return;
        ++certain;
        wrong += error > kNear ? 1 : 0;
        worst = std::max(worst, error);
    }

    void print(const char* name) const {
        std::printf("| %s | %d | %d | %d | %d | %.3f |\n", name, all, near, certain, wrong, worst);
    }
};

/// The methods on one kind of surfaces: with the ends; with ends that must be found, because the
/// patches are lost; and without ends.
struct Tallies {
    Tally literal, literal_without, ours, ours_found, ours_without;

    void add(const RealMask& mask, const Eigen::Matrix3d& turn) {
        const Surface whole = turned(mask.surface, turn);
        const std::vector<Cap> caps = find_caps(whole);
        const Surface wall = without_caps(whole, caps);
        const Vec3 axis = turn * mask.sampling.axes.col(2);
        const Surface bare = without_caps(whole, {});
        const auto with = estimate_stack_orientation(whole, caps);
        const auto found = estimate_stack_orientation(bare, find_caps(bare));
        const auto without = estimate_stack_orientation(wall);
        literal.add(degrees_between(literal_axis(whole), axis), false);
        literal_without.add(degrees_between(literal_axis(wall), axis), false);
        ours.add(degrees_between(with.direction, axis), with.certain);
        ours_found.add(degrees_between(found.direction, axis), found.certain);
        ours_without.add(degrees_between(without.direction, axis), without.certain);
    }

    void print(const std::string& kind) const {
        literal.print((kind + " | the thesis, literally | with").c_str());
        literal_without.print((kind + " | the thesis, literally | without").c_str());
        ours.print((kind + " | ours | with").c_str());
        ours_found.print((kind + " | ours | with, patches lost").c_str());
        ours_without.print((kind + " | ours | without").c_str());
    }
};

/// Ends in the image's first and last slice.
std::ptrdiff_t ends_in_slices(const RealMask& mask) {
    const std::vector<CutEnd> ends = cut_ends(mask.surface);
    return std::ranges::count_if(ends, [&](const CutEnd& end) {
        return degrees_between(end.normal, mask.sampling.axes.col(2)) < 1.0;
    });
}

std::string kind_of(const RealMask& mask, std::ptrdiff_t ends) {
    const bool cubic = VoxelGrid{mask.sampling.axes, mask.sampling.spacing}.is_cubic();
    return std::string(cubic ? "cubic voxels" : "thicker slices") + " | " +
           (ends >= 2   ? "two or more"
            : ends == 1 ? "one"
                        : "none");
}

void print_real_masks(bool each) {
    const std::vector<RealMask> masks = real_masks();
    std::map<std::string, Tallies> kinds;
    for (const RealMask& mask : masks) {
        const std::ptrdiff_t ends = ends_in_slices(mask);
        Tallies& tallies = kinds[kind_of(mask, ends)];
        for (const std::uint64_t seed : {1, 2}) tallies.add(mask, random_rotation(seed));
        if (!each) continue;
        const auto with = estimate_stack_orientation(mask.surface, find_caps(mask.surface));
        std::fprintf(stderr, "%s: %zu faces, %ld ends, ours %.3f deg, confidence %.2f%s\n",
                     mask.name.c_str(), mask.surface.triangle_count(), static_cast<long>(ends),
                     degrees_between(with.direction, mask.sampling.axes.col(2)), with.confidence,
                     with.certain ? ", certain" : "");
    }
    std::printf(
        "| voxels | ends in slices | method | ends | surfaces x 2 rotations | within 5 deg | "
        "called "
        "certain | of these off by more than 5 deg | largest error of these [deg] |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    for (const auto& [kind, tallies] : kinds) tallies.print(kind);
}

}  // namespace

int main(int count, char** words) {
    const std::string only = count > 1 ? words[1] : "";
    if (only == "real") return print_real_masks(true), 0;
    print_organs();
    std::printf("\n");
    print_smoothed_organs();
    std::printf("\n");
    print_spheres();
    std::printf("\n");
    print_real_masks(false);
}
