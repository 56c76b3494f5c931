#include <functional>
#include <map>
#include <random>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/brush/dabs.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

using Pool = std::vector<std::pair<std::string, std::vector<Value>>>;
using Random = std::mt19937;

const Value& any_of(const std::vector<Value>& values, Random& random) {
    return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

/// One to three arguments of the pool.
Arguments any_change(const Pool& pool, Random& random) {
    Arguments change;
    const int count = std::uniform_int_distribution<int>(1, 3)(random);
    for (int i = 0; i < count; ++i) {
        const auto& [name, values] =
            pool[std::uniform_int_distribution<std::size_t>(0, pool.size() - 1)(random)];
        change.set(name, any_of(values, random));
    }
    return change;
}

void require_same(const Scene& a, const Scene& b) {
    REQUIRE(a.surface.has_value() == b.surface.has_value());
    if (!a.surface) return;
    REQUIRE(std::ranges::equal(a.surface->triangles(), b.surface->triangles()));
    REQUIRE(a.surface->points() == b.surface->points());
    REQUIRE(a.surface->patches == b.surface->patches);
    REQUIRE(*a.surface->patch_labels == *b.surface->patch_labels);
    REQUIRE(a.surface->attributes.size() == b.surface->attributes.size());
    for (const auto& [name, values] : a.surface->attributes)
        REQUIRE(*values == *b.surface->attributes.at(name));
}

void require_same(const Outcome& a, const Outcome& b) {
    require_same(a.scene, b.scene);
    REQUIRE(a.resolved == b.resolved);
    REQUIRE(*a.report == *b.report);
    REQUIRE(a.warnings == b.warnings);
}

std::string error_of(const std::function<void()>& run) {
    try {
        run();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

Outcome batch_of(const Operation& operation, const Scene& scene, const Arguments& arguments,
                 Progress& progress) {
    return run_here(operation, scene, checked_arguments(operation, arguments), progress);
}

/// Random changes one after another: the live form has the bits of a batch run with all of them,
/// or fails as it does and stays as it was.
/// \return numbers of changes that succeeded and that failed
std::pair<int, int> check_changes(const std::string& name, const Scene& scene, const Pool& pool,
                                  int changes) {
    const Operation& operation = find_operation(name);
    Random random(7);
    Progress progress;
    Arguments arguments;
    const auto live = operation.start(scene, checked_arguments(operation, arguments), progress);
    int succeeded = 0, failed = 0;
    for (int i = 0; i < changes; ++i) {
        const Arguments change = given_arguments(operation, any_change(pool, random));
        Arguments all = arguments;
        std::string text;
        for (const auto& [key, value] : change.values()) {
            all.set(key, value);
            text += key + "=" + to_text(value) + " ";
        }
        INFO(name << ", change " << i << ": " << text);
        const Scene before = live->scene();
        const Arguments resolved = live->resolved();
        const std::string error = error_of([&] { live->add(change, progress); });
        if (!error.empty()) {
            ++failed;
            CHECK(error ==
                  error_of([&] { static_cast<void>(batch_of(operation, scene, all, progress)); }));
            require_same(live->scene(), before);
            REQUIRE(live->resolved() == resolved);
            require_same(live->outcome(progress), batch_of(operation, scene, arguments, progress));
            continue;
        }
        ++succeeded;
        arguments = all;
        const Outcome batch = batch_of(operation, scene, arguments, progress);
        require_same(live->outcome(progress), batch);
        require_same(live->scene(), batch.scene);
        REQUIRE(live->resolved() == batch.resolved);
    }
    return {succeeded, failed};
}

/// A change that is cancelled leaves everything as it was.
void check_cancel(const std::string& name, const Scene& scene, const Arguments& change) {
    INFO(name);
    const Operation& operation = find_operation(name);
    Progress progress;
    const auto live = operation.start(scene, checked_arguments(operation, {}), progress);
    const Outcome before = live->outcome(progress);
    std::stop_source stop;
    stop.request_stop();
    Progress stopped({}, stop.get_token());
    CHECK_THROWS_AS(live->add(change, stopped), Cancelled);
    require_same(live->outcome(progress), before);
}

/// A tube with caps in slices of 1 mm, beside a ball.
Scene tube_scene() {
    Scene scene;
    scene.surface = mapped(fine_tube(3.0, 12.0, 24), [](const Vec3& p) {
        return Vec3(p.x() + 0.3 * std::round(p.z()), p.y(), p.z());
    });
    scene.sampling = Sampling{.spacing = Vec3(0.5, 0.5, 1.0), .confidence = 1.0};
    scene.neighbours["ball"] = icosphere(2.0, 2, Vec3(9, 0, 6));
    return scene;
}

Scene image_scene() {
    Scene scene;
    scene.image = ball_image(6.0, 20, Vec3(0.8, 0.8, 1.0));
    return scene;
}

Value text(const char* value) {
    return std::string(value);
}

Value whole(std::int64_t value) {
    return value;
}

/// A dab somewhere on the wall of a tube of radius 2 mm along z.
Dab any_dab(Random& random) {
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    const double angle = between(0.0, 6.28), z = between(2.0, 10.0);
    const Vec3 normal(std::cos(angle), std::sin(angle), 0);
    return {.anchor = {.point = 2 * normal + Vec3(0, 0, z), .normal = normal, .radius = 2},
            .radius = between(0.5, 2.0),
            .strength = between(0.0, 1.0),
            .falloff = between(0.0, 1.0)};
}

Records stroke_of(const Dab& dab) {
    return listed({&dab, 1});
}

}  // namespace

SCENARIO("smooth has the same bits live and in one run", "[workbench][live]") {
    const Pool pool = {{"lambda", {0.2, 0.5, 0.8}},
                       {"filter", {text("laplace"), text("taubin"), text("mean-curvature-flow")}},
                       {"iterations", {whole(0), whole(2), whole(5)}},
                       {"rings", {whole(1), whole(2)}},
                       {"mu", {-0.9, -0.1}},
                       {"staircase", {true, false}},
                       {"tau_theta", {0.05, 0.3}},
                       {"beta_min", {0.0, 0.4}},
                       {"caps", {text("keep"), text("smooth"), text("round")}},
                       {"distance", {text("none"), text("linear"), text("margin")}},
                       {"neighbours", {text("ball"), text("nobody")}},
                       {"constraint", {text("none"), text("voxel")}},
                       {"preset", {text("none"), text("cfd")}}};
    const auto [succeeded, failed] = check_changes("smooth", tube_scene(), pool, 40);
    CHECK(succeeded > 10);
    CHECK(failed > 0);
    check_cancel("smooth", tube_scene(), {{"lambda", 0.1}});
}

SCENARIO("extract-surface has the same bits live and in one run", "[workbench][live]") {
    const Pool pool = {{"threshold", {20.0, 1e6, 50.0, -1e6}},
                       {"inside", {text("above"), text("below")}},
                       {"gaussian", {0.0, 0.7}},
                       {"opening", {whole(0), whole(1)}},
                       {"diffusion", {whole(0), whole(3)}},
                       {"resample", {0.7, 1.1}},
                       {"component", {text("largest"), text("all")}},
                       {"method", {text("auto"), text("threshold")}}};
    const auto [succeeded, failed] = check_changes("extract-surface", image_scene(), pool, 40);
    CHECK(succeeded > 10);
    CHECK(failed > 0);
    check_cancel("extract-surface", image_scene(), {{"threshold", 30.0}});
}

SCENARIO("clip-opening has the same bits live and in one run", "[workbench][live]") {
    Scene scene;
    scene.surface = open_tube(2.0, 30.0, 24, 60);
    const Pool pool = {{"tip", {Vec3(0, 0, 30), Vec3(0, 0, 0)}},
                       {"distance", {3.0, 5.0, 7.5}},
                       {"radii", {2.0}},
                       {"kind", {text("inlet"), text("outlet")}},
                       {"inlet", {std::vector<double>{0, 0, 30}}}};
    const auto [succeeded, failed] = check_changes("clip-opening", scene, pool, 12);
    CHECK(succeeded > 3);
    CHECK(failed > 1);
    check_cancel("clip-opening", scene, {{"distance", 4.0}});
}

SCENARIO("decimate has the same bits live and in one run", "[workbench][live]") {
    const Pool pool = {{"share", {0.3, 0.8}},
                       {"triangles", {whole(300)}},
                       {"max_error", {0.05}},
                       {"staircase", {true, false}},
                       {"distance", {text("none"), text("linear")}}};
    const auto [succeeded, failed] = check_changes("decimate", tube_scene(), pool, 12);
    CHECK(succeeded > 1);
    CHECK(failed > 1);
    check_cancel("decimate", tube_scene(), {{"share", 0.4}});
}

SCENARIO("A stroke has the same bits dab by dab and in one run", "[workbench][live]") {
    Scene scene;
    scene.surface = closed_tube(2.0, 12.0, 36, 40);
    const std::string name = GENERATE("brush-smooth", "brush-inflate", "brush-weight");
    INFO(name);
    const Operation& operation = find_operation(name);
    Random random(3);
    Progress progress;
    Arguments arguments;
    const auto live = operation.start(scene, checked_arguments(operation, arguments), progress);
    CHECK_THROWS_WITH(live->outcome(progress), Contains("give dabs"));
    require_same(live->scene(), scene);
    std::vector<Dab> all;
    for (int i = 0; i < 12; ++i) {
        std::vector<Dab> dabs;
        for (int k = 0; k < 1 + i % 3; ++k) dabs.push_back(any_dab(random));
        if (i % 4 == 3) {  // the last dab is off the surface: none is brushed
            const Outcome before = live->outcome(progress);
            dabs.back().anchor.point.x() += 50.0;
            CHECK_THROWS_AS(live->add({{"dabs", listed(dabs)}}, progress), AlgorithmFailure);
            require_same(live->outcome(progress), before);
            continue;
        }
        live->add({{"dabs", listed(dabs)}}, progress);
        all.insert(all.end(), dabs.begin(), dabs.end());
        arguments.set("dabs", listed(all));
        require_same(live->outcome(progress), batch_of(operation, scene, arguments, progress));
    }
    WHEN("a dab is cancelled") {
        const Outcome before = live->outcome(progress);
        std::stop_source stop;
        stop.request_stop();
        Progress stopped({}, stop.get_token());
        CHECK_THROWS_AS(live->add({{"dabs", stroke_of(any_dab(random))}}, stopped), Cancelled);
        THEN("the stroke stays as it was") {
            require_same(live->outcome(progress), before);
        }
    }
    WHEN("a dab is given by a point") {
        const Arguments dab = {{"at", Vec3(2, 0, 6)}, {"radius", 1.0}};
        THEN("it makes a stroke of its own, which is not continued") {
            CHECK_THROWS_WITH(live->add(dab, progress), Contains("stroke of one dab"));
            const auto other = operation.start(scene, checked_arguments(operation, dab), progress);
            const Outcome outcome = other->outcome(progress);
            require_same(outcome, batch_of(operation, scene, outcome.resolved, progress));
            CHECK_THROWS_AS(other->add({{"dabs", stroke_of(any_dab(random))}}, progress),
                            UsageError);
            require_same(other->outcome(progress), outcome);
        }
    }
    WHEN("something else of the stroke is to change") {
        THEN("it is refused") {
            CHECK_THROWS_WITH(live->add({{"passes", whole(9)}}, progress),
                              Contains("stays through a stroke"));
        }
    }
}

SCENARIO("Without figures an operation leaves the same scene", "[workbench][live]") {
    const Operation& decimate = find_operation("decimate");
    Progress progress;
    const Outcome whole_run = run("decimate", tube_scene(), {{"share", 0.4}});
    const auto live =
        decimate.start(tube_scene(), checked_arguments(decimate, {{"share", 0.4}}), progress);
    require_same(live->scene(), whole_run.scene);
    CHECK(live->resolved() == whole_run.resolved);
}
