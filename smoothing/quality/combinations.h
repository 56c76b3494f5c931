#pragma once

#include <utility>
#include <vector>

namespace vesselbench {

/// All combinations with one element of each row; the last row varies fastest.
template <class Element>
[[nodiscard]] std::vector<std::vector<Element>> combinations(
    const std::vector<std::vector<Element>>& rows) {
    std::vector<std::vector<Element>> all = {{}};
    for (const std::vector<Element>& row : rows) {
        std::vector<std::vector<Element>> longer;
        longer.reserve(all.size() * row.size());
        for (const std::vector<Element>& begun : all)
            for (const Element& element : row) {
                longer.push_back(begun);
                longer.back().push_back(element);
            }
        all = std::move(longer);
    }
    return all;
}

}  // namespace vesselbench
