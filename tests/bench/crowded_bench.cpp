// Parts vessels whose contact is not alone: a sac, a furcation or a third vessel is beside it.
// Prints what became of each as one JSON line: bench_crowded separate|stamp|widen
// sac|furcation|third|thread FIRST LAST [CELL]. With VESSELBENCH_DUMP=FOLDER, the surfaces before
// and after are written there.

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "tests/support/crowded_contacts.h"
#include "workbench/operations/table.h"
#include "workbench/session/guarded_run.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Json = nlohmann::ordered_json;

constexpr double kCell = 0.4;        ///< of the grid that surfaces are made on [mm]
constexpr double kLost = 0.3;        ///< farther from the result, an end or a pole is lost [radii]
constexpr double kMostVolume = 0.1;  ///< that a right result may lose or gain [-]

Crowd crowd_from(const std::string& name) {
    if (name == "sac") return Crowd::Sac;
    if (name == "thread") return Crowd::Thread;
    return name == "furcation" ? Crowd::Furcation : Crowd::Third;
}

void dump(const Surface& surface, const std::string& name) {
    if (const char* folder = std::getenv("VESSELBENCH_DUMP"))
        write_surface(surface, std::string(folder) + "/" + name);
}

Arguments arguments_for(const std::string& operation, const CrowdedContact& contact) {
    if (operation == "widen") return {{"width", 1.0}};
    return {{"at", contact.place}};
}

Json facts(const CrowdedContact& contact, const Surface& after) {
    const Surface& before = contact.surface;
    const Connectivity was = connectivity(*before.topology), is = connectivity(*after.topology);
    const double volume_change = volume(after) / volume(before) - 1.0,
                 lost = farthest_kept(contact, after) / contact.thinnest;
    const bool parted = is.components == was.components + 1 || is.genus < was.genus;
    return {{"parted", parted},
            {"volume_percent", 100.0 * volume_change},
            {"lost_radii", lost},
            {"cuts_vessel", cuts_vessel(contact, after)},
            {"wrong",
             cuts_vessel(contact, after) || lost > kLost || std::abs(volume_change) > kMostVolume}};
}

Json line_of(const std::string& name, const std::string& crowd, int number, double cell) {
    const CrowdedContact contact =
        crowded_contact(crowd_from(crowd), static_cast<std::uint64_t>(number), cell);
    const std::string file = crowd + std::to_string(number);
    dump(contact.surface, file + "_before.ply");
    Json line = {{"crowd", crowd},
                 {"number", number},
                 {"parts", connectivity(*contact.surface.topology).components},
                 {"triangles", contact.surface.triangle_count()}};
    Scene scene;
    scene.surface = contact.surface;
    const Operation& operation = find_operation(name);
    Progress progress;
    try {
        std::clock_t start = std::clock();
        const Outcome outcome = run_here(
            operation, scene, checked_arguments(operation, arguments_for(name, contact)), progress);
        const auto seconds = [&] {
            const std::clock_t now = std::clock();
            return static_cast<double>(now - std::exchange(start, now)) / CLOCKS_PER_SEC;
        };
        line["seconds"] = seconds();
        dump(*outcome.scene.surface, file + "_after.ply");
        for (const char* figure : {"waist", "lost_height_mm", "radius_a_mm", "radius_b_mm"})
            if (outcome.report->contains(figure)) line[figure] = outcome.report->at(figure);
        if (name == "widen") {
            line["places"] = outcome.report->at("places").size();
            line["still_narrow"] = outcome.report->at("still_narrow").size();
        }
        line.update(facts(contact, *outcome.scene.surface));
        start = std::clock();
        const auto excess = overreach_of(operation, scene, outcome, progress);
        line["check_seconds"] = seconds();
        (void)connectivity(*scene.surface->topology);  // known in a session, from the edit before
        line["known_seconds"] = seconds();
        if (!excess) return line;
        line["guard"] = excess->code;
        for (const auto& [key, value] : excess->figures) line[key] = value;
    } catch (const DiagnosedFailure& failure) {
        line["refused"] = failure.diagnostics().front().code;
    }
    return line;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 5 && count != 6)
        return std::fputs(
                   "bench_crowded separate|stamp|widen sac|furcation|third|thread FIRST LAST "
                   "[CELL]\n",
                   stderr),
               2;
    const double cell = count == 6 ? std::atof(arguments[5]) : kCell;
    for (int number = std::atoi(arguments[3]); number <= std::atoi(arguments[4]); ++number) {
        std::puts(line_of(arguments[1], arguments[2], number, cell).dump().c_str());
        std::fflush(stdout);
    }
}
