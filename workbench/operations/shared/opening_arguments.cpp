#include "workbench/operations/shared/opening_arguments.h"

#include <cmath>
#include <sstream>

namespace vesselbench {

namespace {

constexpr std::size_t kNumbers = 10;  ///< of one opening in `planes`
constexpr double kUnitLength = 1e-6;  ///< a normal's length differs from 1 by less

Vec3 vector_at(const std::vector<double>& numbers, std::size_t i) {
    return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

PlannedOpening opening_at(const std::vector<double>& numbers, std::size_t i) {
    return {.place = {.tip = vector_at(numbers, i),
                      .plane = {vector_at(numbers, i + 3), vector_at(numbers, i + 6)}},
            .keep = numbers[i + 9] != 0.0,
            .patch = std::nullopt};
}

}  // namespace

std::vector<double> planes_argument(std::span<const PlannedOpening> openings) {
    std::vector<double> numbers;
    for (const PlannedOpening& opening : openings) {
        const OpeningPlace& place = opening.place;
        for (const Vec3& part : {place.tip, place.plane.point, place.plane.normal})
            numbers.insert(numbers.end(), {part.x(), part.y(), part.z()});
        numbers.push_back(opening.keep ? 1.0 : 0.0);
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

std::string names_argument(std::span<const Patch> patches) {
    std::string names;
    for (const Patch& patch : patches)
        names += (names.empty() ? "" : ",") + to_string(patch.kind) + ":" + patch.name;
    return names;
}

std::vector<Patch> patches_in(const std::string& names) {
    std::vector<Patch> patches;
    std::istringstream list(names);
    for (std::string entry; std::getline(list, entry, ',');) {
        const auto colon = entry.find(':');
        if (colon == std::string::npos) break;
        patches.push_back({entry.substr(colon + 1), patch_kind_from(entry.substr(0, colon))});
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
