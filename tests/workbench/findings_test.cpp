#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/wording.h"
#include "geometry/phantoms/phantom.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/openings.h"
#include "tests/support/beginning.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
#include "workbench/findings/question.h"
#include "workbench/findings/stated_ends.h"
#include "workbench/findings/treatment.h"
#include "workbench/operations/table.h"
#include "workbench/review/finding_items.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Json = nlohmann::ordered_json;

namespace {

constexpr double kSure = 0.8;

PhantomPart vessel(const char* name, const Vec3& from, const Vec3& to, double radius) {
    return {.name = name, .shape = VesselShape{.points = {from, to}, .radii = {radius, radius}}};
}

/// A straight vessel with more parts, as an image shows it.
PhantomDescription vessel_with(std::vector<PhantomPart> more) {
    PhantomDescription phantom{.name = "vessel"};
    phantom.parts = {vessel("vessel", {0, 0, -12}, {1, 2, 12}, 2.0)};
    for (PhantomPart& part : more) phantom.parts.push_back(std::move(part));
    phantom.imaging = {
        .spacing = Vec3::Constant(0.4), .margin = 2.0, .blur = Vec3::Constant(0.2), .noise = 20.0};
    phantom.surface_edge = 1.0;
    return phantom;
}

Scene scene_of(const PhantomDescription& description, Bodies bodies = Bodies::Largest) {
    const Image image = make_phantom(description).image;
    const Extraction made = extract_surface(image, {}, {.threshold = 500.0, .bodies = bodies});
    Scene scene;
    scene.surface = made.surface;
    scene.sampling = sampling_of(image);
    return scene;
}

Scene scene_of(const Surface& surface) {
    Scene scene;
    scene.surface = surface;
    return scene;
}

std::vector<Finding> of_kind(const FindingSearch& all, const std::string& kind) {
    std::vector<Finding> found;
    std::ranges::copy_if(all.findings, std::back_inserter(found),
                         [&](const Finding& finding) { return finding.kind == kind; });
    return found;
}

/// The surest finding of a kind is where the fault is.
void check_found(const Scene& scene, const std::string& kind, const Vec3& place, double reach) {
    const auto found = of_kind(find_findings(scene), kind);
    CAPTURE(kind);
    REQUIRE_FALSE(found.empty());
    CAPTURE(found[0].place.transpose(), found[0].certainty);
    CHECK(found[0].certainty >= kSure);
    CHECK((found[0].place - place).norm() < reach);
}

Finding bump_at(const Vec3& place, double size) {
    return {.kind = "bump", .place = place, .size = size, .certainty = 0.9, .evidence = {}};
}

/// A tube whose wall is pushed out by a bump beside its middle.
Surface tube_with_bump() {
    return mapped(fine_tube(2.0, 24.0, 48), [](const Vec3& p) {
        const double share = (p - Vec3(2.0, 0, 12)).norm() / 1.0;
        const double up = share < 1.0 ? 0.7 * (1 - share * share) : 0.0;
        return Vec3(p + up * Vec3::UnitX());
    });
}

/// A tube that narrows in its middle. \param depth half of the share of the radius that is missing
Surface narrowed_tube(double depth) {
    return mapped(closed_tube(2.0, 40.0, 32, 160), [depth](const Vec3& p) {
        const double x = std::min(1.0, std::abs(p.z() - 20.0) / 5.0);
        const double width = 1.0 - depth * (1.0 + std::cos(std::numbers::pi * x));
        return Vec3(width * p.x(), width * p.y(), p.z());
    });
}

/// A project with that tube.
std::string bumpy_project(const std::string& folder = temporary_folder()) {
    write_surface(tube_with_bump(), folder + "/bumpy.stl");
    REQUIRE(run({"new", folder + "/p.vbench", folder + "/bumpy.stl", "--units", "mm"}).exit_code ==
            0);
    return folder + "/p.vbench";
}

Json findings_in(const std::string& project) {
    const ProgramRun listed = run({"findings", project, "--json"});
    INFO(listed.err);
    REQUIRE(listed.exit_code == 0);
    return Json::parse(listed.out);
}

std::string id_of(const Json& findings, const std::string& kind) {
    for (const Json& finding : findings["findings"])
        if (finding["kind"] == kind) return finding["id"];
    return "";
}

}  // namespace

SCENARIO("The registry has each kind once, by a plain name", "[workbench][findings]") {
    std::set<std::string> kinds;
    for (const Detector& detector : detectors()) {
        CHECK(is_plain_name(detector.kind));
        CHECK(kinds.insert(detector.kind).second);
        CHECK(title_of_kind(detector.kind) == detector.title);
    }
    CHECK(title_of_kind("of-another-version") == "of-another-version");
}

SCENARIO("On a sound vessel nothing is called sure", "[workbench][findings]") {
    for (const Finding& finding : find_findings(scene_of(vessel_with({}))).findings) {
        CAPTURE(finding.id());
        CHECK(finding.certainty < kSure);
    }
}

SCENARIO("A narrowing is found, with the operation that widens it", "[workbench][findings]") {
    const Scene scene = scene_of(narrowed_tube(0.2));
    check_found(scene, "narrowing", Vec3(0, 0, 20), 2.0);
    const Finding found = of_kind(find_findings(scene), "narrowing")[0];
    REQUIRE(found.treatment() != nullptr);
    CHECK(found.treatment()->operation == "correct-narrowing");
    CHECK(title_of(found) == "Narrowing: stenosis or artefact?");
    CHECK_THAT(certainty_words(found), Contains("% that the surface is narrower than beside it"));
    CHECK(found.readings.front().anatomy);
    CHECK(of_kind(find_findings(scene_of(closed_tube(2.0, 40.0, 32, 160))), "narrowing").empty());
}

SCENARIO("Faults of the image are found where they are", "[workbench][findings]") {
    const Vec3 wall(-1.9, 0.9, 0);
    check_found(scene_of(vessel_with(
                    {{.name = "bump", .shape = SphereShape{.centre = wall, .radius = 1.1}}})),
                "bump", wall, 2.0);
    check_found(scene_of(vessel_with({vessel("stub", {0.5, 1, 0}, {-3.0, 1, 0}, 0.8)})), "stub",
                {-3.5, 1, 0}, 1.5);
    check_found(
        scene_of(vessel_with({{.name = "apart",
                               .shape = SphereShape{.centre = Vec3(-7, 0, 0), .radius = 1.0}}}),
                 Bodies::All),
        "detached", {-7, 0, 0}, 0.5);
}

SCENARIO("A blind branch is a question, with the odds that decide the vessel ends",
         "[workbench][findings]") {
    const Scene scene = scene_of(vessel_with(
        {vessel("neck", {0.5, 1, 0}, {-4.4, 1, 0}, 1.3),
         {.name = "dome", .shape = SphereShape{.centre = Vec3(-4.4, 1, 0), .radius = 2.6}}}));
    const auto found = of_kind(find_findings(scene), "stub");
    REQUIRE_FALSE(found.empty());
    const Finding& dome = found[0];
    CAPTURE(odds_words(dome));
    REQUIRE(dome.asks());
    CHECK(dome.readings.front().key == "sac");
    CHECK_THAT(title_of(dome), Contains("ac (aneurysm?)") && Contains("stub"));
    CHECK_THAT(certainty_words(dome), Contains("% that a branch ends blind and short"));
    CHECK_THAT(reading_words(dome.readings.front()), Contains("as wide as its neck"));
    double sum = 0.0;
    for (const Reading& reading : dome.readings) sum += reading.odds.value_or(0.0);
    CHECK(sum == Approx(1.0));
    THEN("a plan of the openings states the same odds") {
        const Surface& surface = *scene.surface;
        const OpeningPlan plan = plan_openings(surface, *centerlines_of(surface));
        const auto end = std::ranges::min_element(
            plan.ends, {}, [&](const EndRecord& e) { return (e.place - dome.place).norm(); });
        REQUIRE(end->verdict);
        CHECK(dome.readings.front().odds == Approx(end->verdict->odds.sac));
    }
    THEN("odds that were stated when the ends were decided are stated again") {
        const std::vector<StatedEnd> stated = {{.place = dome.place,
                                                .diameter = 3.0,
                                                .odds = {.opening = 0.1, .sac = 0.7, .bump = 0.2}}};
        const auto again = of_kind(find_findings(scene, stated), "stub");
        CHECK(odds_words(again[0]) == "sac (aneurysm?) 70 %, stub 20 %, vessel 10 %");
    }
}

SCENARIO("Only the artefact of a question is treated", "[workbench][findings]") {
    Finding question = bump_at({1, 2, 3}, 1.0);
    CHECK_NOTHROW(require_answer(question, ""));
    CHECK(title_of(question) == "Bump");
    question.kind = "stub";
    question.readings = {{.key = "sac", .name = "sac (aneurysm?)", .anatomy = true, .odds = 0.88},
                         {.key = "stub", .name = "stub", .odds = 0.1},
                         {.key = "vessel", .name = "vessel", .anatomy = true, .odds = 0.02}};
    CHECK(title_of(question) == "Sac (aneurysm?) or stub?");
    CHECK(kept_reason(question) == "kept: sac (aneurysm?) 88 %, stub 10 %, vessel 2 %");
    CHECK_NOTHROW(require_answer(question, "stub"));
    for (const char* answer : {"", "sac", "vessel", "tumour"}) {
        CAPTURE(answer);
        CHECK_THROWS_AS(require_answer(question, answer), UsageError);
    }
}

SCENARIO("What the ends were taken for is read from the edit that decided them",
         "[workbench][findings]") {
    const auto entry = [](const char* report) {
        LogEntry made;
        ResultRecord result;
        result.report = report;
        made.result = std::make_shared<const ResultRecord>(std::move(result));
        return made;
    };
    const auto stated = stated_ends(
        {entry("{}"), entry("broken"), entry(R"({"ends": 3})"), LogEntry{},
         entry(R"({"ends": [{"place_mm": [1, 2, 3], "odds": {"vessel_mm": 2.0, "opening": 0.1,
                             "sac": 0.8, "bump": 0.1}},
                            {"place_mm": [1, 2, 9], "odds": null},
                            {"place_mm": ["x", 2, 9], "odds": {}}, 7]})")});
    REQUIRE(stated.size() == 1);
    CHECK(stated[0].odds.sac == 0.8);
    CHECK(stated_at(stated, {1, 2, 4.9}, 2.5) == &stated[0]);
    CHECK(stated_at(stated, {1, 2, 5.1}, 2.5) == nullptr);
    CHECK(stated_at(stated, {1, 2, 4.9}, 0.9) == nullptr);
}

SCENARIO("What is more likely wrong than right is folded", "[workbench][findings]") {
    std::vector<Finding> findings(3, bump_at({1, 2, 3}, 1.0));
    findings[1].certainty = 0.5;
    findings[2].certainty = 0.49;
    CHECK(listed_count(findings) == 2);
    CHECK(listed_count(std::span(findings).last(1)) == 0);
    CHECK(folded_words(17) == "17 more below 50 %");
    CHECK(folded_words(17, false) == "17 below 50 %");
}

SCENARIO("The worst finding comes first, and what is unlikely last", "[workbench][findings]") {
    const auto of = [](const char* kind, double certainty) {
        Finding finding = bump_at({1, 2, 3}, 1.0);
        finding.kind = kind;
        finding.certainty = certainty;
        return finding;
    };
    std::vector<Finding> findings = {of("bump", 0.98), of("contact", 0.6), of("contact", 0.9),
                                     of("hole", 0.3),  of("dent", 0.4),    of("narrowing", 0.55)};
    put_worst_first(findings);
    std::vector<std::string> kinds;
    for (const Finding& finding : findings) kinds.push_back(finding.kind);
    CHECK(kinds ==
          std::vector<std::string>{"contact", "contact", "narrowing", "bump", "dent", "hole"});
    CHECK(findings[0].certainty == 0.9);
}

SCENARIO("The review's queue folds findings that are more likely wrong than right",
         "[workbench][findings]") {
    LogEntry last;
    last.edit.edit.id = 7;
    last.result = std::make_shared<const ResultRecord>();
    std::vector<Finding> findings(2, bump_at({1, 2, 3}, 1.0));
    findings[1].certainty = 0.2;
    const auto items = finding_items(findings, {last});
    REQUIRE(items.size() == 2);
    CHECK_FALSE(items[0].folded);
    CHECK(items[1].folded);
    CHECK_THAT(items[1].why, StartsWith("20 % that the wall rises there"));
    const Json queue = queue_json(items);
    CHECK_FALSE(queue[0].contains("folded"));
    CHECK(queue[1]["folded"] == true);
}

SCENARIO("What belongs to the vessel is decided in step Branches", "[workbench][findings]") {
    LogEntry last;
    last.edit.place.step = Step::Product;
    const auto step = [&](const char* operation) {
        return treatment_step(find_operation(operation), {last});
    };
    CHECK(step("remove-branch") == Step::Branches);
    CHECK(step("brush-smooth") > Step::Branches);
}

SCENARIO("A bridge between vessels is a handle", "[workbench][findings]") {
    PhantomDescription phantom = vessel_with({});
    phantom.parts = {vessel("trunk", {0, 0, -12}, {0, 0, 0}, 2.0),
                     vessel("one", {0, 0, 0}, {7, 0, 12}, 1.5),
                     vessel("other", {0, 0, 0}, {-7, 0, 12}, 1.5),
                     vessel("bridge", {4.2, 0, 7.2}, {-4.2, 0, 7.2}, 0.8)};
    const auto found = of_kind(find_findings(scene_of(phantom)), "handle");
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].place.z() - 7.2) < 2.0);
    REQUIRE(found[0].treatment());
    CHECK(found[0].treatment()->operation == "separate");
    CHECK_THAT(title_of(found[0]), Contains("ring of vessels") && Contains("vessels that touch"));
}

SCENARIO("Faults of the triangles are found", "[workbench][findings]") {
    const Surface tube = fine_tube(2.0, 24.0, 36);
    WHEN("the wall has a hole") {
        std::vector<Triangle> kept;
        PatchLabels labels;
        for (TriangleId t = 0; t < tube.triangle_count(); ++t) {
            const Triangle& corners = tube.triangles()[t];
            if ((tube.points()[corners[0]] - Vec3(2.0, 0, 12)).norm() < 0.6) continue;
            kept.push_back(corners);
            labels.push_back((*tube.patch_labels)[t]);
        }
        check_found(scene_of(make_surface(tube.points(), kept, labels, tube.patches)), "hole",
                    {2.0, 0, 12}, 0.5);
    }
    WHEN("the wall passes through itself") {
        check_found(
            scene_of(mapped(tube,
                            [](const Vec3& p) {
                                const double share = (p - Vec3(2.0, 0, 12)).squaredNorm() / 1.5;
                                return Vec3(p - 5.0 * std::max(0.0, 1 - share) * Vec3::UnitX());
                            })),
            "self-intersection", {-2.0, 0, 12}, 2.0);
    }
    WHEN("an end is cut obliquely") {
        check_found(scene_of(mapped(tube,
                                    [](const Vec3& p) {
                                        const double z = p.z() / 24.0;
                                        return Vec3(p + 0.6 * p.x() * z * Vec3::UnitZ());
                                    })),
                    "oblique-end", {0, 0, 24}, 1.0);
    }
    WHEN("none of this is so") {
        CHECK(find_findings(scene_of(tube)).findings.empty());
    }
}

SCENARIO("Walls nearly in contact are found, and walls that are not are none",
         "[workbench][findings]") {
    // A hairpin of radius 1 mm, whose legs are `gap` apart.
    const auto hairpin = [](double gap) {
        const double leg = 10.0, bend = 1.0 + 0.5 * gap;
        const double length = 2.0 * leg + bend * std::numbers::pi;
        return scene_of(mapped(fine_tube(1.0, length, 24), [&](const Vec3& p) {
            const double beyond = p.z() - leg, angle = beyond / bend;
            if (beyond < 0.0) return Vec3(bend + p.x(), p.y(), beyond);
            if (angle > std::numbers::pi)
                return Vec3(-bend - p.x(), p.y(), std::numbers::pi * bend - beyond);
            const double out = bend + p.x();
            return Vec3(out * std::cos(angle), p.y(), out * std::sin(angle));
        }));
    };
    const auto found = of_kind(find_findings(hairpin(0.3)), "contact");
    REQUIRE_FALSE(found.empty());
    CHECK(found[0].certainty >= kSure);
    CHECK(std::abs(found[0].place.x()) < 0.3);
    CHECK(of_kind(find_findings(hairpin(3.0)), "contact").empty());
}

SCENARIO("Only the image's voxels make a vessel a thread", "[workbench][findings]") {
    Scene scene = scene_of(fine_tube(0.3, 24.0, 12));
    CHECK(of_kind(find_findings(scene), "thread").empty());
    scene.sampling = Sampling{.spacing = Vec3::Constant(2.0), .confidence = 1.0};
    CHECK_FALSE(of_kind(find_findings(scene), "thread").empty());
    scene.sampling->spacing = Vec3::Constant(0.4);
    CHECK(of_kind(find_findings(scene), "thread").empty());
}

SCENARIO("Steps of thick slices are found", "[workbench][findings]") {
    PhantomDescription thick = vessel_with({});
    thick.parts = {vessel("oblique", {-8, 0, -8}, {8, 2, 8}, 2.5)};
    thick.imaging.spacing = Vec3(0.4, 0.4, 1.2);
    const Image mask = make_phantom(thick).mask;
    Scene scene;
    scene.surface = extract_surface(mask, {}, {.method = ExtractionMethod::Labels}).surface;
    scene.sampling = sampling_of(mask);
    const auto found = of_kind(find_findings(scene), "staircases");
    REQUIRE(found.size() == 1);
    CHECK(found[0].certainty >= kSure);
    REQUIRE(found[0].treatment() != nullptr);
    CHECK(found[0].treatment()->operation == "smooth");
}

SCENARIO("Findings do not depend on where a model lies, and on its size", "[workbench][findings]") {
    const Surface bumpy = tube_with_bump();
    const auto found = of_kind(find_findings(scene_of(bumpy)), "bump");
    REQUIRE(found.size() == 1);
    const auto elsewhere = [](const Vec3& p) {
        return Vec3(10.0 * (skew_rotation() * p) + Vec3(100, -50, 7));
    };
    const auto moved = of_kind(find_findings(scene_of(mapped(bumpy, elsewhere))), "bump");
    REQUIRE(moved.size() == 1);
    CHECK((moved[0].place - elsewhere(found[0].place)).norm() < 5.0);
    CHECK(moved[0].size == Approx(10.0 * found[0].size).epsilon(0.1));
    CHECK(moved[0].certainty == Approx(found[0].certainty).margin(0.1));
}

SCENARIO("Every treatment is an operation with arguments it takes", "[workbench][findings]") {
    Scene scene = scene_of(vessel_with({vessel("stub", {0.5, 1, 0}, {-3.5, 1, 0}, 0.8)}));
    for (const Finding& finding : find_findings(scene).findings) {
        CAPTURE(finding.id());
        const Remedy* treatment = finding.treatment();
        if (treatment == nullptr) continue;
        const Operation& operation = find_operation(treatment->operation);
        GivenArguments given(operation);
        for (const auto& [name, value] : treatment->arguments) given.set(name, value);
        CHECK_NOTHROW(check_complete(given));
        CHECK(std::ranges::count(operation.allowed, treatment_step(operation, {})) == 1);
    }
}

SCENARIO("An id names a kind and a place", "[workbench][findings]") {
    const std::vector<Finding> findings = {bump_at({1, 2, 3}, 1.0), bump_at({1, 2, 5}, 1.0)};
    CHECK(findings[0].id() == "bump@1,2,3");
    CHECK(finding_of_id(findings, "bump@1,2,3") == &findings[0]);
    CHECK(finding_of_id(findings, "bump@1,2,4.8") == &findings[1]);
    CHECK(finding_of_id(findings, "bump@1,2,9") == nullptr);
    CHECK(finding_of_id(findings, "dent@1,2,3") == nullptr);
    for (const char* wrong : {"", "bump", "@1,2,3", "bump@1,2", "bump@1,2,3,4", "bump@1,2,nan",
                              "bump@1,2,x", "bump@\x1b[31m"})
        CHECK_THROWS_AS(finding_of_id(findings, wrong), UsageError);
}

SCENARIO("Certainty grows from what is as likely as not", "[workbench][findings]") {
    CHECK(certainty_of(2.0, 2.0, 3.0) == Approx(0.5));
    CHECK(certainty_of(3.0, 2.0, 3.0) == Approx(0.8));
    CHECK(certainty_of(1.0, 2.0, 1.0) == Approx(0.8));
    CHECK(certainty_of(1e9, 2.0, 3.0) == Approx(0.98));
    CHECK(certainty_of(-1e9, 2.0, 3.0) == Approx(0.02));
}

SCENARIO("A dismissal hides its finding, and no other place", "[workbench][findings]") {
    const Dismissal dismissal{.kind = "bump", .place = {1, 2, 3}, .size = 1.0};
    CHECK(is_of(dismissal, bump_at({1.1, 2, 3}, 1.1)));
    CHECK_FALSE(is_of(dismissal, bump_at({1, 2, 4}, 1.0)));
    CHECK_FALSE(is_of(dismissal, bump_at({1, 2, 3}, 2.0)));  // it has grown
    const JudgedFindings all =
        judged({{bump_at({1, 2, 3}, 1.0), bump_at({1, 2, 5}, 1.0)}, {}},
               {dismissal, {.kind = "bump", .place = {9, 9, 9}, .size = 1.0}});
    REQUIRE(all.open.size() == 1);
    CHECK(all.open[0].place.z() == 5.0);
    REQUIRE(all.dismissed.size() == 2);
    CHECK(all.dismissed[0].finding);
    CHECK_FALSE(all.dismissed[1].finding);
}

SCENARIO("Each of two near findings has its own dismissal", "[workbench][findings]") {
    const Finding sure = bump_at({1, 2, 3}, 1.0), other = bump_at({1, 2, 3.4}, 1.0);
    const Dismissal of_other{.kind = "bump", .place = other.place, .size = 1.0};
    const JudgedFindings one = judged({{sure, other}, {}}, {of_other});
    REQUIRE(one.open.size() == 1);
    CHECK(one.open[0].place == sure.place);
    const Dismissal of_sure{.kind = "bump", .place = sure.place, .size = 1.0};
    CHECK(judged({{sure, other}, {}}, {of_other, of_sure}).open.empty());
}

SCENARIO("A dismissal is taken back when its finding is gone", "[workbench][findings]") {
    const std::string project = bumpy_project();
    const std::string id = id_of(findings_in(project), "bump");
    REQUIRE(run({"findings", project, "--dismiss", id, "--reason", "a plaque"}).exit_code == 0);
    REQUIRE(run({"apply", project, "brush-smooth", "at=2.7,0,12", "radius=2", "strength=1",
                 "passes=100"})
                .exit_code == 0);
    CHECK_THAT(run({"findings", project}).out, Contains(id + " (no longer found)"));
    REQUIRE(run({"findings", project, "--restore", id}).exit_code == 0);
    CHECK(findings_in(project)["dismissed"].empty());
}

SCENARIO("What could not be looked for is said", "[workbench][findings]") {
    const Surface plate = make_surface({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}},
                                       {{0, 1, 2}, {0, 2, 3}});  // it has no lumen
    const FindingSearch search = find_findings(scene_of(plate));
    std::vector<std::string> kinds;
    for (const auto& [kind, reason] : search.not_searched) {
        kinds.push_back(kind);
        CHECK_FALSE(reason.empty());
    }
    CHECK_THAT(kinds, Catch::Matchers::VectorContains(std::string("narrowing")));
    const auto lines =
        not_searched_lines({{"bump", "no lines"}, {"hole", "no rims"}, {"dent", "no lines"}});
    REQUIRE(lines.size() == 2);
    CHECK(lines[0] == "not looked for: Bump, Dent: no lines");
    CHECK(find_findings(scene_of(vessel_with({}))).not_searched.empty());
}

SCENARIO("A finding is dismissed with a reason that stays in the project's record",
         "[workbench][findings]") {
    static const Beginning beginning([](const std::string& folder) {
        const std::string project = bumpy_project(folder);
        const std::string id = id_of(findings_in(project), "bump");
        REQUIRE_FALSE(id.empty());
        const std::string reason = "a \x1b[31mtrue\x1b[0m <script> 'bump' \"here\"\nit stays";
        REQUIRE(run({"findings", project, "--dismiss", id, "--reason", reason}).exit_code == 0);
        const Json now = findings_in(project);
        CHECK(id_of(now, "bump").empty());
        REQUIRE(now["dismissed"].size() == 1);
        CHECK(now["dismissed"][0]["reason"] == reason);
        const ProgramRun listed = run({"findings", project});
        CHECK(listed.exit_code == 0);
        CHECK(listed.out.find('\x1b') == std::string::npos);
        const ProgramRun audit = run({"audit", project, "--json"});
        CHECK(audit.exit_code == 0);
        CHECK_THAT(audit.out, Contains("finding " + id));
        return std::pair(project, id);
    });
    const auto& [project, id] = beginning.again();
    WHEN("the bump is smoothed away") {
        REQUIRE(run({"apply", project, "brush-smooth", "at=2.7,0,12", "radius=2", "strength=1",
                     "passes=100"})
                    .exit_code == 0);
        THEN("the dismissal is of nothing that is found") {
            CHECK(findings_in(project)["dismissed"][0]["id"].is_null());
        }
    }
    WHEN("an edit changes the model elsewhere") {
        REQUIRE(run({"apply", project, "brush-smooth", "at=-2,0,4", "radius=1"}).exit_code == 0);
        THEN("it stays dismissed") {
            CHECK(id_of(findings_in(project), "bump").empty());
        }
    }
    WHEN("it is restored") {
        REQUIRE(run({"findings", project, "--restore", id}).exit_code == 0);
        CHECK(id_of(findings_in(project), "bump") == id);
        CHECK(run({"findings", project, "--restore", id}).exit_code == 2);
    }
}

SCENARIO("A question is kept with a word, and nothing removes it unanswered",
         "[workbench][findings]") {
    static const Beginning beginning([](const std::string& folder) {
        const Scene scene = scene_of(vessel_with({vessel("stub", {0.5, 1, 0}, {-3.5, 1, 0}, 0.8)}));
        write_surface(*scene.surface, folder + "/s.stl");
        const std::string project = folder + "/p.vbench";
        REQUIRE(run({"new", project, folder + "/s.stl", "--units", "mm"}).exit_code == 0);
        const Json found = findings_in(project);
        const std::string id = id_of(found, "stub");
        REQUIRE_FALSE(id.empty());
        for (const Json& finding : found["findings"]) {
            CHECK(finding["certain_of"].is_string());
            CHECK(finding["readings"].empty() == (finding["kind"] != "stub"));
            for (const Json& reading : finding["readings"]) CHECK(reading["odds"].is_number());
        }
        return std::pair(project, id);
    });
    const auto& [project, id] = beginning.again();
    const Json before = Json::parse(run({"log", project, "--json"}).out);
    const std::string listed = run({"findings", project}).out;
    CHECK_THAT(listed, Contains("sac (aneurysm?)") && Contains("--keep " + id) &&
                           Contains("--apply " + id + " --as stub"));
    WHEN("it is applied without an answer, or as anatomy") {
        for (const std::vector<std::string>& answer :
             {std::vector<std::string>{}, {"--as", "sac"}, {"--as", "vessel"}}) {
            std::vector<std::string> words = {"findings", project, "--apply", id};
            words.insert(words.end(), answer.begin(), answer.end());
            const ProgramRun refused = run(words);
            CHECK(refused.exit_code == 2);
            CHECK_THAT(refused.err, Contains("anatomy"));
        }
        THEN("the model stays") {
            CHECK(Json::parse(run({"log", project, "--json"}).out) == before);
        }
    }
    WHEN("it is kept") {
        REQUIRE(run({"findings", project, "--keep", id}).exit_code == 0);
        const Json now = findings_in(project);
        CHECK(id_of(now, "stub").empty());
        CHECK_THAT(now["dismissed"][0]["reason"].get<std::string>(),
                   Contains("kept: ") && Contains("sac (aneurysm?)"));
    }
    WHEN("it is answered as a stub") {
        const ProgramRun made = run({"findings", project, "--apply", id, "--as", "stub", "--json"});
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
        const Json edit = Json::parse(made.out);
        CHECK(edit["operation"] == "remove-branch");
        CHECK(edit["step"] == "branches");
        CHECK_THAT(edit["note"].get<std::string>(), Contains("Stub (of: "));
    }
}

SCENARIO("Corrections are tried before they are offered", "[workbench][findings]") {
    const std::string folder = temporary_folder();
    for (const double depth : {0.2, 0.4}) {  // the second one is nearly closed
        CAPTURE(depth);
        const std::string name = folder + "/" + formatted(depth);
        write_surface(narrowed_tube(depth), name + ".stl");
        const std::string project = name + ".vbench";
        REQUIRE(run({"new", project, name + ".stl", "--units", "mm"}).exit_code == 0);
        const Json tried = Json::parse(run({"findings", project, "--try", "--json"}).out);
        REQUIRE_FALSE(tried["findings"].empty());
        const Json& narrowing = tried["findings"][0];
        CHECK(narrowing["kind"] == "narrowing");
        CHECK(narrowing["refusal"].is_string() == (depth > 0.3));
        const std::string listed = run({"findings", project, "--try"}).out;
        CHECK((listed.find("--as artefact") == std::string::npos) == (depth > 0.3));
        CHECK((listed.find("cannot be treated: the vessel is nearly closed") !=
               std::string::npos) == (depth > 0.3));
        CHECK_FALSE(findings_in(project)["findings"][0].contains("refusal"));
    }
}

SCENARIO("A finding that is applied becomes an edit that says why", "[workbench][findings]") {
    const std::string project = bumpy_project();
    const std::string id = id_of(findings_in(project), "bump");
    REQUIRE_FALSE(id.empty());
    const ProgramRun accepted = run({"findings", project, "--apply", id, "--json"});
    INFO(accepted.err);
    REQUIRE(accepted.exit_code == 0);
    const Json edit = Json::parse(accepted.out);
    CHECK(edit["operation"] == "brush-smooth");
    CHECK_THAT(edit["note"].get<std::string>(), Contains("Bump: the wall rises"));
}

SCENARIO("The findings command refuses what makes no sense", "[workbench][findings]") {
    const std::string project = bumpy_project();
    const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
        arguments.insert(arguments.begin(), {"findings", project});
        const ProgramRun result = run(arguments);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK_THAT(result.err, Contains(why));
    };
    refused({"--dismiss", "bump@1,2,3"}, "--reason");
    refused({"--reason", "because"}, "--dismiss");
    refused({"--dismiss", "bump@1,2,3", "--reason", "because"}, "no finding");
    refused({"--apply", "bump"}, "is no finding");
    refused({"--apply", "bump@1,2,3", "--dismiss", "bump@1,2,3"}, "excludes");
    refused({"--as", "stub"}, "--apply");
    const std::string id = id_of(findings_in(project), "bump");
    refused({"--keep", id}, "--reason");
    refused({"--dismiss", id, "--reason", " \n"}, "reason");
    refused({"--dismiss", id, "--reason", std::string(3000, 'x')}, "longer");
    refused({"--dismiss", id, "--reason", "\xff\xfe"}, "UTF-8");
    CHECK(findings_in(project)["dismissed"].empty());
}

SCENARIO("Without a surface there is nothing to find", "[workbench][findings]") {
    CHECK_THROWS_AS(find_findings(Scene{}), AlgorithmFailure);
}
