// A sac or a vessel's end that an operation takes away without naming it is caught, whatever the
// operation did to all triangles; what the same operation does honestly is not.

#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "tests/support/iso_surface.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/table.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kParent = 2.5, kBranch = 1.5, kSac = 2.5;  ///< radii [mm]
constexpr double kCell = 0.4;                               ///< [mm]
const Vec3 kDome(0, -4.5 - kSac, 3);                        ///< the sac's pole
const Vec3 kEnd(14 + kBranch, 0, -5);                       ///< tip of the branch

enum class Part { None, Sac, Branch };

/// A vessel along z, a branch along x and a sac on the other side.
Surface vessel_without(Part part) {
    const ImplicitShape shape = [&](const Vec3& p) {
        double wall = capsule(p, {0, 0, -16}, {0, 0, 16}, kParent);
        if (part != Part::Branch)
            wall = std::min(wall, capsule(p, {0, 0, -5}, {14, 0, -5}, kBranch));
        if (part != Part::Sac) wall = std::min(wall, (p - Vec3(0, -4.5, 3)).norm() - kSac);
        return wall;
    };
    const Surface raw = iso_surface(shape, {Vec3(-4.1, -8.1, -20.1), Vec3(17.1, 4.1, 20.1)}, kCell);
    return *run("repair", raw, {{"caps", false}}).scene.surface;
}

/// What the lying row below does.
std::string copied;
Part taken = Part::None;

/// The operation, but on a vessel of which a part is gone.
Outcome lie(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Operation& honest = find_operation(copied);
    Scene without = scene;
    if (taken != Part::None) without.surface = vessel_without(taken);
    return run_here(honest, without, checked_arguments(honest, arguments), progress);
}

const Operation& find_liar(const std::string& name) {
    static Operation liar;
    if (name != copied) return find_operation(name);
    liar = find_operation(name);
    liar.run = &lie;
    liar.start = nullptr;
    liar.isolated = false;
    return liar;
}

/// The code that an edit is refused with; empty: it was made.
std::string refusal(const std::string& name, Part part, const Arguments& arguments,
                    Diagnostic& why) {
    copied = name;
    taken = part;
    SessionOptions options{.find = find_liar};
    options.worker.command = {program_path(), "--worker"};
    Session session = Session::unsaved(options);
    static const std::string file = temporary_folder() + "/vessel.vtp";
    write_surface(vessel_without(Part::None), file);
    session.apply("load-surface", {{"file", file}, {"units", std::string("mm")}});
    const Scene before = session.scene();
    try {
        session.apply(name, arguments);
        return "";
    } catch (const DiagnosedFailure& failure) {
        why = failure.diagnostics().front();
        CHECK(session.log().size() == 1);
        CHECK(session.scene().surface->positions == before.surface->positions);
        return why.code;
    }
}

const Arguments kCutAll{{"check", std::string("none")}};

}  // namespace

SCENARIO("A sac or an end that is gone without being named is refused with its place",
         "[workbench][overreach]") {
    const auto [name, arguments] =
        GENERATE(std::pair<std::string, Arguments>{"decimate", {}},
                 std::pair<std::string, Arguments>{"subdivide", {}},
                 std::pair<std::string, Arguments>{"clip-opening", kCutAll});
    INFO(name);
    Diagnostic why;
    CHECK(refusal(name, Part::None, arguments, why) == "");

    CHECK(refusal(name, Part::Sac, arguments, why) == "edit-loses-wall");
    CHECK(why.operation == name);
    CHECK((why.place.value() - kDome).norm() < kSac);
    CHECK(why.figures.at("distance_mm") == Approx(-kDome.y() - kParent).margin(1.0));
    CHECK(why.figures.at("stated_mm") < why.figures.at("distance_mm"));

    CHECK(refusal(name, Part::Branch, arguments, why) == "edit-loses-wall");
    CHECK((why.place.value() - kEnd).norm() < 2.0 * kBranch);
    CHECK(why.figures.at("distance_mm") > 8.0);
}
