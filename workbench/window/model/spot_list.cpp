#include "workbench/window/model/spot_list.h"

#include <algorithm>
#include <exception>

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

SpotList::SpotList(std::function<void()> wake) : wake_(std::move(wake)) {
    reading_.emplace(wake_);
    storing_.emplace(wake_);
}

SpotList::~SpotList() {
    finish();
}

// --- the project

void SpotList::open(const std::filesystem::path& project, std::string read_only) {
    close();
    project_ = project;
    blocked_ = std::move(read_only);
    reading_->start([project](const Progress&) { return stored_spots(project); });
}

std::string SpotList::close() {
    std::string lost = finish();
    reading_.emplace(wake_);
    storing_.emplace(wake_);
    project_.clear();
    blocked_.clear();
    failure_.clear();
    spots_.clear();
    chosen_ = 0;
    return lost;
}

bool SpotList::update() {
    const bool read = reading_->poll(), stored = storing_->poll();
    if (auto spots = reading_->take()) spots_ = std::move(*spots);
    // What cannot be read is not written over.
    if (read && !reading_->problem().empty())
        blocked_ = "the stored spots cannot be read: " + reading_->problem();
    if (stored) failure_ = storing_->problem();
    if (stored && failure_.empty() && !storing_->pending()) unsaved_ = false;
    return read || stored;
}

void SpotList::keep() {
    if (project_.empty() || !blocked_.empty()) return;
    unsaved_ = true;
    storing_->start_after([project = project_, spots = spots_](const Progress&) {
        store_spots(project, spots);
        return Nothing{};
    });
}

/// What was asked for last may still wait. \return why it is lost; empty: it is not
std::string SpotList::finish() {
    reading_.reset();
    storing_.reset();
    if (!std::exchange(unsaved_, false)) return "";
    try {
        store_spots(project_, spots_);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

// --- the spots

const Spot* SpotList::chosen() const {
    return spots_.empty() ? nullptr : &spots_[std::min(chosen_, spots_.size() - 1)];
}

void SpotList::add(const Vec3& point, const Vec3& normal) {
    spots_.push_back({free_name(spots_), point, normal});
    chosen_ = spots_.size() - 1;
    keep();
}

void SpotList::rename(std::size_t spot, const std::string& name) {
    if (spots_.at(spot).name == name) return;
    spots_[spot].name = name;
    keep();
}

void SpotList::remove(std::size_t spot) {
    spots_.erase(spots_.begin() + static_cast<std::ptrdiff_t>(spot));
    if (chosen_ > spot || (chosen_ > 0 && chosen_ == spots_.size())) --chosen_;
    keep();
}

}  // namespace vesselbench
