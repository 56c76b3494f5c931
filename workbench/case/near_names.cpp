#include "workbench/case/near_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Letters to insert, to delete or to change (Levenshtein 1966).
std::size_t letters_apart(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, change}));
        }
    }
    return row[b.size()];
}

bool one_begins_with_the_other(const std::string& a, const std::string& b) {
    return a.size() >= 2 && (b.starts_with(a) || a.starts_with(b));
}

}  // namespace

std::vector<std::string> near_names(const std::string& name, std::span<const std::string> names) {
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& candidate : names) {
        const std::size_t apart = letters_apart(name, candidate);
        if (apart <= 1 + name.size() / 4)
            near.emplace_back(apart, candidate);
        else if (one_begins_with_the_other(name, candidate))
            near.emplace_back(name.size(), candidate);
    }
    std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
    near.resize(std::min<std::size_t>(near.size(), 3));
    std::vector<std::string> result;
    for (auto& [apart, candidate] : near) result.push_back(std::move(candidate));
    return result;
}

std::string did_you_mean(const std::string& name, std::span<const std::string> names) {
    const std::vector<std::string> near = near_names(name, names);
    if (near.empty()) return "";
    return "; did you mean '" + joined(near, "' or '") + "'?";
}

}  // namespace vesselbench
