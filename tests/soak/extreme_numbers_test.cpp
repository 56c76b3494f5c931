// Every number of every operation at the ends of what its parameter allows: a slip of a unit ends
// in a result or in a text, not in hours of work or without memory.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/soak/random_arguments.h"
#include "tests/support/operation_examples.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "workbench/case/checked_value.h"
#include "workbench/operations/table.h"
#include "workbench/worker/worker.h"

using namespace vesselbench;
using namespace std::chrono_literals;

namespace {

/// Far above what a run takes on these small scenes, even on a loaded machine.
WorkerOptions limits() {
    return {.command = {test::program_path(), "--worker"},
            .time_limit = 20s,
            .memory_limit = std::size_t{3} << 30};
}

Outcome run(const std::string& operation, const Scene& scene, const Arguments& arguments) {
    const Operation& found = find_operation(operation);
    return run_in_worker(found, scene, checked_arguments(found, arguments), {}, limits());
}

/// Whether the process of a run was ended by its limits or by a crash, whose texts say so.
bool was_ended(const std::exception& error) {
    return std::string(error.what()).find("the project is unchanged") != std::string::npos;
}

/// Why a run ended as none should; empty: it gave a finite result, or said what it cannot do.
std::string trouble(const std::string& operation, const Scene& scene, const Arguments& arguments) {
    try {
        const Outcome outcome = run(operation, scene, arguments);
        const auto finite = [](const Vec3& p) { return p.allFinite(); };
        const bool all =
            !outcome.scene.surface || std::ranges::all_of(outcome.scene.surface->points(), finite);
        return all ? "" : "its surface is not finite";
    } catch (const UsageError&) {
        return "";
    } catch (const InvalidInput& error) {
        return was_ended(error) ? error.what() : "";
    } catch (const AlgorithmFailure& error) {
        return was_ended(error) ? error.what() : "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

/// On the tube below.
test::ExampleGround ground(const soak::SmallFiles& files) {
    const auto file = [&](const char* name) { return (files.folder() / name).string(); };
    return {.radius = 2.0,
            .wall = Vec3(2, 0, 8),
            .end = Vec3(0, 0, 16),
            .branch = Vec3(2, 0, 12),
            .files = {{InputKind::Surface, file("closed.vtp")},
                      {InputKind::Image, file("lumen.nrrd")},
                      {InputKind::Neighbour, file("closed.vtp")}},
            .mask = file("mask.nrrd")};
}

/// A value with which the condition holds.
Value met(const Operation& operation, const Condition& condition,
          const test::ExampleGround& ground) {
    if (!condition.values.empty()) return condition.values.front();
    const Parameter& needed = find_parameter(operation, condition.parameter);
    if (needed.type == ParameterType::File) return ground.mask;
    if (needed.meaning == Meaning::Tip) return ground.end;
    if (needed.meaning == Meaning::Place) return ground.wall;
    return checked_value(needed, Value("1"));
}

/// What the operation needs beside the parameter, so that its number matters.
Arguments companions(const Operation& operation, const Parameter& parameter,
                     const soak::SmallFiles& files) {
    Arguments all = test::example_arguments(operation, ground(files));
    if (const auto& condition = parameter.only_with) {
        all.set(condition->parameter, met(operation, *condition, ground(files)));
        if (condition->parameter == "staircase") all.set("stack_axis", Vec3(0, 0, 1));
    }
    return all;
}

/// Numbers at the ends of the parameter's range, and far out in it; none of other types.
std::vector<Value> extremes(const Parameter& parameter) {
    std::vector<Value> wanted;
    const double ends[] = {parameter.minimum, parameter.maximum};
    std::vector<double> numbers = {0.0};
    for (const double end : ends)
        if (std::isfinite(end)) numbers.push_back(end);
    for (const double size : {1e-308, 1e-6, 1e6, 1e308}) {
        numbers.push_back(size);
        numbers.push_back(-size);
    }
    for (const double number : numbers) {
        if (parameter.type == ParameterType::Real) wanted.emplace_back(number);
        if (parameter.type == ParameterType::Point)
            wanted.emplace_back(Vec3(number, number, number));
        if (parameter.type == ParameterType::Integer && std::abs(number) <= 1e6)
            wanted.emplace_back(static_cast<std::int64_t>(number));
    }
    if (parameter.type == ParameterType::Integer)
        for (const std::int64_t number : {INT64_MIN, std::int64_t{1}, INT64_MAX})
            wanted.emplace_back(number);
    std::vector<Value> allowed;
    std::set<std::string> seen;
    for (const Value& value : wanted) try {
            if (seen.insert(to_text(value)).second)
                allowed.push_back(checked_value(parameter, value));
        } catch (const UsageError&) {
            // out of its range
        }
    return allowed;
}

/// A tube along z with its openings, a neighbour beside it, and an image.
Scene tube_scene(const soak::SmallFiles& files) {
    Scene scene = run("load-image", {}, {{"file", (files.folder() / "lumen.nrrd").string()}}).scene;
    scene.surface = test::closed_tube(2.0, 16.0, 12, 10);
    scene.neighbours.emplace(
        "bone", test::mapped(test::open_tube(1.0, 16.0, 12, 10),
                             [](const Vec3& p) { return Vec3(p + Vec3(5.0, 0.0, 0.0)); }));
    return scene;
}

}  // namespace

SCENARIO("Extreme numbers end in a result or a text, within time and memory", "[soak][extremes]") {
    const soak::SmallFiles files(test::temporary_folder() + "/files");
    const Scene tube = tube_scene(files);
    Scene open = tube;
    open.surface = test::open_tube(2.0, 16.0, 12, 10);
    std::size_t runs = 0;
    for (const Operation& operation : operation_table())
        for (const Parameter& parameter : operation.parameters)
            for (const Value& number : extremes(parameter)) {
                Arguments arguments = companions(operation, parameter, files);
                arguments.set(parameter.name, number);
                const Scene& scene = operation.example.scene == ExampleScene::Holes ? open : tube;
                const std::string found = trouble(operation.name, scene, arguments);
                INFO(operation.name << " " << parameter.name << "=" << to_text(number) << ": "
                                    << found);
                CHECK(found.empty());
                ++runs;
            }
    CHECK(runs > 300);
}

SCENARIO("The usual arguments beside extreme numbers work", "[soak][extremes]") {
    const soak::SmallFiles files(test::temporary_folder() + "/files");
    const Scene tube = tube_scene(files);
    for (const Operation& operation : operation_table()) {
        const ExampleScene needed = operation.example.scene;
        if (needed == ExampleScene::Holes || needed == ExampleScene::Branches ||
            needed == ExampleScene::Contact)
            continue;
        CAPTURE(operation.name);
        CHECK_NOTHROW(run(operation.name, tube, companions(operation, {}, files)));
    }
}
