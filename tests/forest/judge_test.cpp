#include "tests/forest/judge.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_file.h"
#include "tests/forest/grow.h"
#include "tests/forest/model.h"
#include "tests/support/paths.h"

using namespace vesselbench;
using namespace vesselbench::forest;

namespace {

struct Case {
    Plan plan;
    Tree tree;
    Truth truth;
};

Case case_of(const Plan& plan) {
    Case made{.plan = plan, .tree = grow(plan), .truth = {}};
    form_ends(made.tree, plan);
    made.truth = truth_of(made.tree, plan);
    return made;
}

/// The first tree of three long vessels whose ends are all closed flat, across the vessel.
Case case_with_flat_ends() {
    for (std::uint64_t seed = 1;; ++seed) {
        Case made =
            case_of({.seed = seed, .kind = CaseKind::ClosedSurface, .ends = 3, .triangles = 8'000});
        const bool good = std::ranges::all_of(made.truth.ends, [&](const auto& end) {
            const auto& branch = made.truth.branches[end.branch];
            return end.kind == EndKind::Flat && branch.free_length() > 4.0 * branch.diameter();
        });
        if (good) return made;
    }
}

/// The true surface as a product: a patch for each flat end, the inlet first.
Surface as_product(const Case& from, std::size_t inlet) {
    const Surface surface = tree_surface(from.tree, from.plan);
    std::vector<Patch> patches = {{"wall", PatchKind::Wall}};
    for (std::size_t e = 0; e < from.truth.ends.size(); ++e)
        patches.push_back(e == inlet ? Patch{"inlet", PatchKind::Inlet}
                                     : Patch{"outlet_" + std::to_string(e), PatchKind::Outlet});
    PatchLabels labels(surface.triangle_count(), 0);
    for (std::size_t t = 0; t < labels.size(); ++t)
        for (std::size_t e = 0; e < from.truth.ends.size(); ++e) {
            const End& end = from.truth.ends[e];
            if (std::ranges::all_of(surface.triangles()[t], [&](VertexId v) {
                    const Vec3 d = surface.points()[v] - end.place;
                    return std::abs(d.dot(end.rim_normal)) < 1e-6 && d.norm() < 1.5 * end.radius;
                }))
                labels[t] = static_cast<std::uint16_t>(e + 1);
        }
    return surface.with_patches(std::move(labels), std::move(patches));
}

/// What the judge objects to in a product.
std::set<std::string> objections(const Truth& truth, const Surface& product, bool flow) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / "vesselbench_judge_test";
    fs::create_directories(folder);
    write_surface(product, (folder / "surface.vtp").string());
    write_file(folder / "report.json", "{}");
    const auto verdict = judge(truth, folder, flow);
    fs::remove_all(folder);
    std::set<std::string> found;
    for (const auto& failure : verdict.at("failures")) found.insert(failure.at("what"));
    CHECK(verdict.at("right") == found.empty());
    return found;
}

using Objections = std::set<std::string>;

/// The truth whose branch 1 goes on as another one, too thin to be lost, from this share of it.
Truth divided(Truth truth, double share, bool optional) {
    Truth::Branch rest = truth.branches[1];
    const double length = length_of(rest.line);
    truth.branches[1].line = part_of(rest.line, 0.0, share * length);
    truth.branches[1].end.reset();
    rest.line = part_of(rest.line, share * length, length);
    rest.free_from = 0.0;
    rest.resolved = false;
    truth.ends[*rest.end].branch = truth.branches.size();
    truth.ends[*rest.end].optional = optional;
    truth.branches.push_back(rest);
    return truth;
}

}  // namespace

SCENARIO("The judge of the forest accepts the truth and nothing else", "[forest][judge]") {
    const Case tree = case_with_flat_ends();
    THEN("the true surface is right for both purposes") {
        CHECK(objections(tree.truth, as_product(tree, 0), true) == Objections{});
        CHECK(objections(tree.truth, as_product(tree, 0), false) == Objections{});
    }
    THEN("another inlet is wrong") {
        CHECK(objections(tree.truth, as_product(tree, 1), true) == Objections{"wrong inlet"});
    }
    THEN("closed ends are wrong") {
        Surface closed = as_product(tree, 0);
        PatchLabels labels = *closed.patch_labels;
        std::ranges::replace(labels, std::uint16_t{1}, std::uint16_t{0});
        std::ranges::replace(labels, std::uint16_t{2}, std::uint16_t{0});
        closed = closed.with_patches(labels, closed.patches);
        CHECK(objections(tree.truth, closed, true) ==
              Objections{"inlet closed", "inlets", "end closed"});
    }
    THEN("a vessel cut to half its length is wrong") {
        Case shorter = tree;
        Branch& branch = shorter.tree.branches[1];
        branch.length *= 0.5;
        branch.end->place = at_abscissa(branch.line, branch.length).at;
        branch.end->direction = branch.end->rim_normal = tangent_at(branch.line, branch.length);
        branch.line = part_of(branch.line, 0.0, branch.length + 2.0 * branch.end->radius);
        shorter.truth = truth_of(shorter.tree, shorter.plan);
        CHECK(objections(tree.truth, as_product(shorter, 0), true) == Objections{"cut off"});
        CHECK(objections(tree.truth, as_product(shorter, 0), false) == Objections{"branch lost"});
        for (const bool optional : {true, false}) {
            CAPTURE(optional);
            CHECK(objections(divided(tree.truth, 0.55, optional), as_product(shorter, 0), true) ==
                  (optional ? Objections{} : Objections{"end closed", "opening invented"}));
        }
    }
    THEN("a cap far off is wrong, and one off by 1 degree is right") {
        // Farther than the triangles show.
        for (const double angle : {20.0, 1.0}) {
            Case tilted = tree;
            End& end = *tilted.tree.branches[1].end;
            // out of the plane in which the vessel bends, so that no place nearby explains it
            const Line& line = tilted.tree.branches[1].line;
            const double before = tilted.tree.branches[1].length - 0.5 * end.radius;
            const Vec3 bend = end.direction - tangent_at(line, before);
            const Vec3 axis =
                bend.norm() > 1e-6 ? bend.normalized() : end.direction.unitOrthogonal();
            end.rim_normal = Eigen::AngleAxisd(angle * M_PI / 180.0, axis) * end.direction;
            tilted.truth = truth_of(tilted.tree, tilted.plan);
            CHECK(objections(tree.truth, as_product(tilted, 0), true) ==
                  (angle > 2.0 ? Objections{"cap tilted"} : Objections{}));
            Truth lenient = tree.truth;
            lenient.ends[*lenient.branches[1].end].optional = true;
            CHECK(objections(lenient, as_product(tilted, 0), true) == Objections{});
        }
    }
    THEN("truth.json says all that is judged by") {
        const Truth read = truth_from(to_json(tree.truth));
        CHECK(to_json(read) == to_json(tree.truth));
        CHECK(objections(read, as_product(tree, 0), true) == Objections{});
    }
}

SCENARIO("The forest's trees are what their truth says", "[forest]") {
    for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{55}}) {
        INFO("seed " << seed);
        const Case tree = case_of(plan_for(seed));
        CHECK(to_json(case_of(plan_for(seed)).truth) == to_json(tree.truth));
        const Connectivity found = connectivity(*tree_surface(tree.tree, tree.plan).topology);
        CHECK(found.manifold);
        CHECK(found.components == 1);
        CHECK(found.genus == tree.truth.genus);
        CHECK(found.boundary_loops == tree.truth.ends.size());
        CHECK(std::ranges::count(tree.truth.ends, true, &Truth::TrueEnd::inlet) == 1);
        for (const auto& end : tree.truth.ends)
            CHECK((end.inlet || 1.09 * end.radius < tree.truth.ends[0].radius));
    }
}
