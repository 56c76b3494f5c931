#include "workbench/operations/shared/opening_arguments.h"

#include <cmath>
#include <sstream>

namespace vesselbench {

namespace {

constexpr std::size_t kNumbers = 10;        ///< of one opening in `planes`
constexpr std::size_t kClosingNumbers = 4;  ///< of one end in `closings`
constexpr double kUnitLength = 1e-6;        ///< a normal's length differs from 1 by less

Vec3 vector_at(const std::vector<double>& numbers, std::size_t i) {
    return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

constexpr double kKeptCap = 1.0, kCappedRim = 2.0, kRenamed = 3.0;

OpeningWay way_of(double number) {
    if (number == kCappedRim) return OpeningWay::CapRim;
    if (number == kRenamed) return OpeningWay::Rename;
    return number == 0.0 ? OpeningWay::Cut : OpeningWay::KeepCap;
}

double number_of(OpeningWay way) {
    if (way == OpeningWay::CapRim) return kCappedRim;
    if (way == OpeningWay::Rename) return kRenamed;
    return way == OpeningWay::KeepCap ? kKeptCap : 0.0;
}

PlannedOpening opening_at(const std::vector<double>& numbers, std::size_t i) {
    return {.place = {.tip = vector_at(numbers, i),
                      .plane = {vector_at(numbers, i + 3), vector_at(numbers, i + 6)}},
            .way = way_of(numbers[i + 9]),
            .patch = std::nullopt};
}

std::string escaped(const std::string& name) {
    std::string text;
    for (const char letter : name)
        text += letter == ',' ? "%2C" : letter == '%' ? "%25" : std::string(1, letter);
    return text;
}

std::string unescaped(const std::string& text) {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string code = text.substr(i, 3);
        const bool known = code == "%2C" || code == "%25";
        name += known ? (code == "%2C" ? ',' : '%') : text[i];
        i += known ? 2 : 0;
    }
    return name;
}

}  // namespace

std::vector<double> planes_argument(std::span<const PlannedOpening> openings) {
    std::vector<double> numbers;
    for (const PlannedOpening& opening : openings) {
        const OpeningPlace& place = opening.place;
        for (const Vec3& part : {place.tip, place.plane.point, place.plane.normal})
            numbers.insert(numbers.end(), {part.x(), part.y(), part.z()});
        numbers.push_back(number_of(opening.way));
    }
    return numbers;
}

std::vector<PlannedOpening> openings_in(const std::vector<double>& planes) {
    if (planes.size() % kNumbers != 0) return {};
    std::vector<PlannedOpening> openings;
    for (std::size_t i = 0; i < planes.size(); i += kNumbers) {
        openings.push_back(opening_at(planes, i));
        if (std::abs(openings.back().place.plane.normal.norm() - 1.0) > kUnitLength) return {};
    }
    return openings;
}

std::vector<double> closings_argument(std::span<const PlannedClosing> closings) {
    std::vector<double> numbers;
    for (const auto& [place, way] : closings)
        numbers.insert(numbers.end(), {place.x(), place.y(), place.z(), static_cast<double>(way)});
    return numbers;
}

std::vector<PlannedClosing> closings_in(const std::vector<double>& closings) {
    if (closings.size() % kClosingNumbers != 0) return {};
    std::vector<PlannedClosing> found;
    for (std::size_t i = 0; i < closings.size(); i += kClosingNumbers) {
        const double way = closings[i + 3];
        if (way != 0.0 && way != 1.0 && way != 2.0) return {};
        found.push_back({vector_at(closings, i), static_cast<ClosingWay>(static_cast<int>(way))});
    }
    return found;
}

std::vector<EndRecord> ends_of(const OpeningPlan& plan) {
    std::vector<EndRecord> ends;
    for (const PlannedClosing& closing : plan.closings)
        ends.push_back(
            {.place = closing.place,
             .fate = closing.way == ClosingWay::RemoveStub ? EndFate::Removed : EndFate::Closed});
    for (std::size_t i = 0; i < plan.openings.size(); ++i) {
        const PlannedOpening& opening = plan.openings[i];
        ends.push_back({.place = opening.place.tip,
                        .diameter = opening.place.diameter,
                        .fate = opening.way == OpeningWay::Cut ? EndFate::Opened : EndFate::Kept,
                        .opening = i});
    }
    return ends;
}

std::string names_argument(std::span<const Patch> patches) {
    std::string names;
    for (const Patch& patch : patches)
        names += (names.empty() ? "" : ",") + to_string(patch.kind) + ":" + escaped(patch.name);
    return names;
}

std::vector<Patch> patches_in(const std::string& names) {
    std::vector<Patch> patches;
    std::istringstream list(names);
    for (std::string entry; std::getline(list, entry, ',');) {
        const auto colon = entry.find(':');
        if (colon == std::string::npos) break;
        patches.push_back(
            {unescaped(entry.substr(colon + 1)), patch_kind_from(entry.substr(0, colon))});
    }
    return patches;
}

Patch chosen_patch(const std::optional<Patch>& present, const std::optional<std::string>& kind,
                   const std::optional<std::string>& name) {
    Patch patch = present.value_or(Patch{"", PatchKind::Outlet});
    if (kind) patch.kind = patch_kind_from(*kind);
    if (name || patch.name.empty()) patch.name = name.value_or(to_string(patch.kind));
    return patch;
}

}  // namespace vesselbench
