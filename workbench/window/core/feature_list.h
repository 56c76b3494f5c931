#pragma once

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "workbench/window/core/feature.h"

namespace vesselbench {

/// The features of a window, in the order of their updates.
class FeatureList {
public:
    void add(std::unique_ptr<Feature> feature) { all_.push_back(std::move(feature)); }

    [[nodiscard]] const std::vector<std::unique_ptr<Feature>>& all() const { return all_; }

    /// The feature of this type. \throw std::logic_error if it is not in the list
    template <class Type>
    [[nodiscard]] Type& get() const {
        for (const auto& feature : all_)
            if (auto* found = dynamic_cast<Type*>(feature.get())) return *found;
        throw std::logic_error("the window lacks a feature");
    }

private:
    std::vector<std::unique_ptr<Feature>> all_;
};

}  // namespace vesselbench
