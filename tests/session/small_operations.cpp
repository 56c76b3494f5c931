#include "tests/session/small_operations.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "tests/session/forbidden_acts.h"
#include "tests/support/one_thread.h"
#include "tests/support/shapes.h"

namespace vesselbench::test {

namespace {

using Json = nlohmann::ordered_json;

Outcome made(Scene scene, const Arguments& arguments) {
    Outcome result;
    result.report = std::make_shared<const Json>(Json{{"arguments", arguments.values().size()}});
    result.scene = std::move(scene);
    result.resolved = arguments;
    return result;
}

Outcome make_sphere(const Scene&, const Arguments& arguments, Progress& progress) {
    progress.report(0.5, "rounding");
    Outcome result = made({}, arguments);
    const Vec3 centre = arguments.optional_point("centre").value_or(Vec3(1.0, 2.0, 1.0 / 3.0));
    result.resolved.set("centre", centre);
    result.scene.surface =
        icosphere(arguments.real("radius"), static_cast<int>(arguments.integer("levels")), centre);
    return result;
}

double number_in(const std::string& path) {
    std::ifstream file(path);
    double number = 0.0;
    if (!(file >> number)) throw IoError("cannot read " + path);
    return number;
}

Outcome load_sphere(const Scene&, const Arguments& arguments, Progress&) {
    Outcome result = made({}, arguments);
    result.scene.surface = icosphere(number_in(arguments.text("file")), 2);
    return result;
}

Outcome make_image(const Scene&, const Arguments& arguments, Progress&) {
    const auto edge = static_cast<int>(arguments.integer("edge"));
    Outcome result = made({}, arguments);
    Image image;
    image.size = {edge, edge, edge};
    std::vector<float> voxels(image.voxel_count());
    const double start = number_in(arguments.text("file"));
    for (std::size_t i = 0; i < voxels.size(); ++i)
        voxels[i] = static_cast<float>(start + 0.25 * static_cast<double>(i % 1000));
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    result.scene.image = image;
    return result;
}

Outcome bump(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const Surface& surface = surface_of(scene);
    Positions points = surface.points();
    const double height = arguments.optional_real("height").value_or(0.01 * points[0].norm());
    std::size_t moved = 0;
    for (Vec3& p : points) {
        if ((p - arguments.point("at")).norm() > arguments.real("reach")) continue;
        p.z() += height;
        ++moved;
    }
    progress.report(0.5, "pushing");
    if (moved == 0) {
        Diagnostic nothing = plain_text("no vertex lies within reach of the place");
        nothing.remedies = {{.arguments = {{"reach", "100"}}}};
        throw DiagnosedFailure(std::move(nothing));
    }
    Outcome result =
        made(with_surface(scene, surface.with_positions(std::move(points))), arguments);
    result.resolved.set("height", height);
    if (moved == 1) result.warnings.push_back(plain_text("only one vertex moved"));
    return result;
}

/// Bumps one after the other, as a brush does; a height of 0 fails.
class Stroke : public Stepper {
public:
    Stroke(const Scene& scene, const Arguments& checked)
        : scene_(scene), arguments_(checked), heights_(checked.list("heights")) {
        for (const double height : heights_) push(height);
    }

    void add(const Arguments& more, Progress& progress) override {
        progress.report(0.5, "brushing");
        const Scene before = scene_;
        const std::size_t count = heights_.size();
        try {
            for (const double height : more.list("heights")) {
                push(height);
                heights_.push_back(height);
            }
        } catch (...) {
            scene_ = before;
            heights_.resize(count);
            throw;
        }
        arguments_.set("heights", heights_);
    }

    [[nodiscard]] const Scene& scene() const override { return scene_; }

    [[nodiscard]] virtual const Arguments& resolved() const { return arguments_; }

    [[nodiscard]] Outcome outcome(Progress& progress) override {
        progress.report(0.9, "measuring");
        return made(scene_, arguments_);
    }

private:
    void push(double height) {
        if (height == 0.0) throw AlgorithmFailure("a height of 0 changes nothing");
        const Surface& surface = surface_of(scene_);
        Positions points = surface.points();
        for (Vec3& p : points)
            if (p.z() > 0.0) p.z() += height * std::sin(p.x());
        scene_ = with_surface(scene_, surface.with_positions(std::move(points)));
    }

    Scene scene_;
    Arguments arguments_;
    std::vector<double> heights_;
};

std::unique_ptr<Stepper> start_stroke(const Scene& scene, const CheckedArguments& arguments,
                                      Progress&) {
    return std::make_unique<Stroke>(scene, arguments);
}

Outcome stroke(const Scene& scene, const Arguments& arguments, Progress& progress) {
    return Stroke(scene, arguments).outcome(progress);
}

Outcome scale(const Scene& scene, const Arguments& arguments, Progress&) {
    const double factor = arguments.real("factor");
    return made(with_surface(scene, mapped(surface_of(scene),
                                           [&](const Vec3& p) { return Vec3(factor * p); })),
                arguments);
}

Outcome flatten(const Scene& scene, const Arguments& arguments, Progress&) {
    Surface surface = surface_of(scene);
    PatchLabels labels(surface.triangle_count(), 0);
    labels.front() = 1;
    surface = surface.with_patches(std::move(labels),
                                   {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}});
    std::vector<double> weights(surface.vertex_count(), 0.5);
    weights.back() = 1.0 / 3.0;
    surface.attributes["weight"] = std::make_shared<const std::vector<double>>(std::move(weights));
    Outcome result = made(with_surface(scene, surface), arguments);
    result.scene.neighbours["bone"] = icosphere(3.0, 1);
    result.scene.sampling = Sampling{};
    VolumeMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    mesh.boundary = {{0, 2, 1}};
    mesh.boundary_patches = {0};
    mesh.patches = {{"wall", PatchKind::Wall}};
    result.scene.volume_mesh = std::make_shared<const VolumeMesh>(std::move(mesh));
    return result;
}

Outcome crash(const Scene&, const Arguments&, Progress&) {
    std::raise(SIGSEGV);
    return {};
}

Outcome be_stopped(const Scene&, const Arguments&, Progress&) {
    std::raise(SIGTERM);
    return {};
}

Outcome read_much(const Scene& scene, const Arguments& arguments, Progress&) {
    const std::vector<char> content(static_cast<std::size_t>(arguments.integer("megabytes")) << 20,
                                    '\1');
    Outcome result = made(scene, arguments);
    result.warnings.push_back(plain_text(std::to_string(content.back())));
    return result;
}

Outcome hang(const Scene&, const Arguments&, Progress& progress) {
    for (int i = 0; i < 6000; ++i) {
        progress.report(0.001 * (i % 1000), "waiting");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {};
}

/// Never checks for a cancel, and reports progress back and forth.
Outcome stubborn(const Scene& scene, const Arguments& arguments, Progress& progress) {
    progress.report(0.6, "digging in");
    progress.report(0.2, "digging in");
    std::this_thread::sleep_for(std::chrono::duration<double>(arguments.real("seconds")));
    return made(scene, arguments);
}

Outcome greedy(const Scene& scene, const Arguments& arguments, Progress&) {
    std::vector<double> all(std::size_t{1} << 30, 1.0);
    Outcome result = made(scene, arguments);
    result.warnings.push_back(plain_text(std::to_string(all.back())));
    return result;
}

/// Its warning is the number of the process, its device a GPU's.
Outcome where(const Scene& scene, const Arguments& arguments, Progress&) {
    Outcome result = made(scene, arguments);
    result.warnings.push_back(plain_text(std::to_string(getpid())));
    result.device = "gpu";
    return result;
}

Outcome refuse(const Scene&, const Arguments& arguments, Progress&) {
    const std::string as = arguments.text("as");
    if (as == "usage") throw UsageError("refused as usage");
    if (as == "input") throw InvalidInput("refused as input");
    if (as == "io") throw IoError("refused as io");
    if (as == "library") throw std::length_error("vector::_M_default_append");
    throw AlgorithmFailure("refused as algorithm");
}

Parameter real(const char* name, std::optional<Value> value) {
    Parameter parameter;
    parameter.name = name;
    parameter.unit = "mm";
    parameter.default_value = std::move(value);
    parameter.help = "A number.";
    return parameter;
}

Parameter typed(const char* name, ParameterType type, bool required) {
    Parameter parameter;
    parameter.name = name;
    parameter.type = type;
    parameter.required = required;
    parameter.help = "A value.";
    return parameter;
}

Parameter whole(const char* name, std::int64_t value) {
    Parameter parameter = typed(name, ParameterType::Integer, false);
    parameter.default_value = value;
    return parameter;
}

Operation operation(const char* name, Step step, OperationFunction run,
                    std::vector<Parameter> parameters) {
    Operation row;
    row.name = name;
    row.usual_step = step;
    row.allowed = {step};
    row.summary = "For tests.";
    row.parameters = std::move(parameters);
    row.run = run;
    return row;
}

Operation isolated(Operation made) {
    made.isolated = true;
    return made;
}

std::vector<Operation> make_operations() {
    const std::vector<Parameter> bump_parameters = {
        typed("at", ParameterType::Point, true), real("reach", 1.0), real("height", std::nullopt)};
    const Parameter file = typed("file", ParameterType::File, true);
    std::vector<Operation> all = {
        operation("make-sphere", Step::Source, make_sphere,
                  {real("radius", 10.0), whole("levels", 2),
                   typed("centre", ParameterType::Point, false)}),
        operation("load-sphere", Step::Source, load_sphere, {file}),
        operation("make-image", Step::Source, make_image, {file, whole("edge", 20)}),
        operation("bump", Step::LocalRepair, bump, bump_parameters),
        operation("scale", Step::Remeshing, scale, {real("factor", 2.0)}),
        operation("flatten", Step::Openings, flatten, {}),
        isolated(operation("far-bump", Step::LocalRepair, bump, bump_parameters)),
        isolated(operation("crash", Step::Smoothing, crash, {})),
        isolated(operation("crash-on-file", Step::Source, crash, {file})),
        isolated(operation("be-stopped", Step::Source, be_stopped, {file})),
        isolated(operation("read-much", Step::Source, read_much, {file, whole("megabytes", 100)})),
        isolated(operation("hang", Step::Smoothing, hang, {})),
        isolated(operation("greedy", Step::Smoothing, greedy, {})),
        isolated(
            operation("refuse", Step::Smoothing, refuse, {typed("as", ParameterType::Text, true)})),
        isolated(operation(
            "act", Step::Source, forbidden_act,
            {typed("file", ParameterType::File, false), typed("what", ParameterType::Text, true),
             typed("at", ParameterType::Text, false)})),
    };
    const Parameter heights = typed("heights", ParameterType::List, true);
    all.push_back(operation("stroke", Step::LocalRepair, stroke, {heights}));
    all.back().start = start_stroke;
    all.push_back(operation("stubborn", Step::LocalRepair, stubborn, {real("seconds", 30.0)}));
    all.push_back(
        operation("where", Step::Smoothing, where, {typed("here", ParameterType::Flag, true)}));
    all.back().stays_here = [](const Arguments& arguments) { return arguments.flag("here"); };
    all[3].allowed = {Step::Source, Step::LocalRepair, Step::Smoothing, Step::Remeshing};
    return all;
}

}  // namespace

const Operation& find_test_operation(const std::string& name) {
    static const std::vector<Operation> all = make_operations();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& o) { return o.name == name; });
    if (found == all.end()) throw UsageError("there is no operation '" + name + "'");
    return *found;
}

std::string helper_program() {
    return VESSELBENCH_TEST_HELPER;
}

WorkerOptions test_worker() {
    WorkerOptions options;
    options.command = {helper_program(), "worker"};
    return options;
}

}  // namespace vesselbench::test
