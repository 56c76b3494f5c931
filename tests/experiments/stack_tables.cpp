// Prints Tables 5.6 and 5.7 of the thesis with our figures, as Markdown, for scripts/experiments.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "geometry/kernel/surface.h"
#include "smoothing/context/stack_orientation.h"
#include "tests/support/stack_phantoms.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

void print_error(const Surface& surface, const Eigen::Matrix3d& turn) {
    const auto found = estimate_stack_orientation(turned(surface, turn));
    std::printf(" %.3f%s |", degrees_between(found.direction, turn.col(2)),
                found.certain ? "" : " (uncertain)");
}

void print_organs() {
    const std::array<Surface, 6> surfaces = {of_mask(vessel_in_slices()),
                                             of_mask(muscle_in_slices()),
                                             of_mask(organ_in_slices()),
                                             of_masked_intensities(vessel_in_slices()),
                                             of_masked_intensities(muscle_in_slices()),
                                             of_masked_intensities(organ_in_slices())};
    std::printf(
        "| rotation | vessel, mask | muscle, mask | liver, mask | vessel, intensities | muscle, "
        "intensities | liver, intensities |\n|---|---|---|---|---|---|---|\n");
    for (const auto& [axis, name] : {std::pair{Vec3(1, 0, 0), "x"}, std::pair{Vec3(0, 1, 0), "y"}})
        for (int angle = 0; angle <= 90; angle += 30) {
            std::printf("| %s %d deg |", name, angle);
            const Eigen::Matrix3d turn =
                Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, axis).toRotationMatrix();
            for (const Surface& surface : surfaces) print_error(surface, turn);
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

}  // namespace

int main() {
    print_organs();
    std::printf("\n");
    print_spheres();
}
