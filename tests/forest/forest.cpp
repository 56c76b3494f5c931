// The forest: random vessel trees with known truth (docs/science/forest.md). scripts/forest.py runs
// it.
//
//   forest list FIRST LAST            prints what the cases hold, about
//   forest plant SEED FOLDER          writes the case and its truth.json
//   forest judge FOLDER RESULT GOAL   compares what `prepare` made of it with the truth

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_file.h"
#include "tests/forest/grow.h"
#include "tests/forest/judge.h"
#include "tests/forest/model.h"
#include "tests/forest/truth.h"

namespace vesselbench::forest {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Figures of a surface for the summary line, and what is wrong with it as a case.
std::string facts_of(const Surface& surface, const Truth& truth, bool open) {
    const Connectivity found = connectivity(*surface.topology);
    std::string text = std::to_string(surface.triangle_count()) + " triangles";
    if (!found.manifold) text += ", NOT MANIFOLD";
    if (found.components != 1) text += ", " + std::to_string(found.components) + " PARTS";
    if (open == found.closed) text += open ? ", NOT OPEN" : ", NOT CLOSED";
    if (found.genus && *found.genus != truth.genus)
        text += ", GENUS " + std::to_string(*found.genus);
    const auto rims = std::ranges::count_if(
        truth.ends, [](const auto& end) { return end.kind != EndKind::Rounded; });
    if (open && found.boundary_loops != static_cast<std::size_t>(rims))
        text += ", " + std::to_string(found.boundary_loops) + " RIMS, NOT " + std::to_string(rims);
    return text;
}

/// Triangles of a case's surface, about, and a hundredth of its image's voxels.
double size_of(const Plan& plan, const Tree& tree) {
    constexpr double kTrianglesPerEdge2 = 2.8;
    const double area = kTrianglesPerEdge2 * wall_area(tree);
    const Voxels voxels = voxels_for(plan, tree);
    if (is_image(plan.kind))
        return area / (voxels.pixel * voxels.slice) +
               0.01 * box_of(tree).volume() / (voxels.pixel * voxels.pixel * voxels.slice);
    const double edge = plan.kind == CaseKind::VoxelSurface ? voxels.pixel : edge_for(plan, tree);
    return area / (edge * edge);
}

int list(std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t seed = first; seed <= last; ++seed) {
        const Plan plan = plan_for(seed);
        Tree tree = grow(plan);
        const double size = size_of(plan, tree);
        form_ends(tree, plan);
        const Truth truth = truth_of(tree, plan);
        std::printf("%d\t%s\t%zu ends\ttrunk %.1f mm\t%s\tsize %.0f\n", static_cast<int>(seed),
                    truth.kind.c_str(), truth.ends.size(), plan.trunk, truth.features.c_str(),
                    size);
    }
    return 0;
}

int plant(std::uint64_t seed, const fs::path& folder) {
    fs::create_directories(folder);
    const Plan plan = plan_for(seed);
    Tree tree = grow(plan);
    form_ends(tree, plan);
    Truth truth = truth_of(tree, plan);
    std::string facts;
    if (is_image(plan.kind)) {
        const Image image = tree_image(tree, plan);
        write_image((folder / truth.file).string(), image);
        facts = std::to_string(image.voxel_count()) + " voxels";
    } else {
        const Surface surface = plan.kind == CaseKind::VoxelSurface ? voxel_surface(tree, plan)
                                                                    : tree_surface(tree, plan);
        write_surface(surface, (folder / truth.file).string());
        facts = facts_of(surface, truth, plan.kind == CaseKind::OpenSurface);
        // Siblings at a small angle may touch once more beyond their furcation: the surface has a
        // loop there that the tree knows nothing of.
        if (plan.kind != CaseKind::VoxelSurface)
            truth.genus = connectivity(*surface.topology).genus.value_or(truth.genus);
    }
    write_file(folder / "truth.json", to_json(truth).dump(1));
    std::printf(
        "seed %3d: %s, trunk %.1f mm, %zu ends (%d asked), %d loops, %zu kisses, %zu sacs, %s\n",
        static_cast<int>(seed), truth.kind.c_str(), plan.trunk, truth.ends.size(), plan.ends,
        tree.loops, truth.kisses.size(), truth.sacs.size(), facts.c_str());
    return 0;
}

int judge_case(const fs::path& folder, const fs::path& result, const std::string& goal) {
    const Truth truth = truth_from(Json::parse(file_content(folder / "truth.json")));
    std::puts(judge(truth, result, goal == "cfd").dump().c_str());
    return 0;
}

}  // namespace

}  // namespace vesselbench::forest

int main(int count, char** words) {
    using namespace vesselbench::forest;
    try {
        const std::string what = count > 1 ? words[1] : "";
        if (what == "list" && count == 4) return list(std::stoull(words[2]), std::stoull(words[3]));
        if (what == "plant" && count == 4) return plant(std::stoull(words[2]), words[3]);
        if (what == "judge" && count == 5) return judge_case(words[2], words[3], words[4]);
        std::fputs(
            "forest list FIRST LAST | forest plant SEED FOLDER | forest judge FOLDER RESULT "
            "cfd|rp\n",
            stderr);
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "forest: %s\n", error.what());
        return 1;
    }
}
