#include "workbench/window/features/gallery/spot_list.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

namespace {

/// The first "Spot 1", "Spot 2" ... that is free.
std::string free_name(const std::vector<Spot>& spots) {
    for (std::size_t number = 1;; ++number) {
        std::string name = "Spot " + std::to_string(number);
        if (std::ranges::find(spots, name, &Spot::name) == spots.end()) return name;
    }
}

}  // namespace

SpotList::SpotList(std::function<void()> wake)
    : list_(std::move(wake), {.what = "spots", .read = stored_spots, .store = store_spots}) {}

void SpotList::open(const std::filesystem::path& project, std::string read_only) {
    chosen_ = 0;
    list_.open(project, std::move(read_only));
}

std::string SpotList::close() {
    chosen_ = 0;
    return list_.close();
}

const Spot* SpotList::chosen() const {
    return all().empty() ? nullptr : &all()[std::min(chosen_, all().size() - 1)];
}

void SpotList::add(const Vec3& point, const Vec3& normal) {
    list_.change([&](std::vector<Spot>& spots) {
        spots.push_back({free_name(spots), point, normal});
    });
    chosen_ = all().size() - 1;
}

void SpotList::rename(std::size_t spot, const std::string& name) {
    if (all().at(spot).name == name) return;
    list_.change([&](std::vector<Spot>& spots) { spots[spot].name = name; });
}

void SpotList::remove(std::size_t spot) {
    list_.change([&](std::vector<Spot>& spots) {
        spots.erase(spots.begin() + static_cast<std::ptrdiff_t>(spot));
    });
    if (chosen_ > spot || (chosen_ > 0 && chosen_ == all().size())) --chosen_;
}

}  // namespace vesselbench
