#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "workbench/session/stored_spots.h"
#include "workbench/window/case/stored_list.h"

namespace vesselbench {

/// The spots of the project in the window, as StoredList keeps them.
class SpotList {
public:
    /// \param wake as StoredList's
    explicit SpotList(std::function<void()> wake);

    /// As StoredList's.
    void open(const std::filesystem::path& project, std::string read_only);

    std::string close();

    bool update() { return list_.update(); }

    /// True once those that were stored are known.
    [[nodiscard]] bool is_read() const { return list_.is_read(); }

    [[nodiscard]] bool pending() const { return list_.pending(); }

    [[nodiscard]] const std::vector<Spot>& all() const { return list_.all(); }

    /// The one that is magnified; none: there are no spots.
    [[nodiscard]] const Spot* chosen() const;

    void choose(std::size_t spot) { chosen_ = spot; }

    /// Adds a spot, "Spot 1", and chooses it.
    void add(const Vec3& point, const Vec3& normal);

    void rename(std::size_t spot, const std::string& name);
    void remove(std::size_t spot);

    /// Why changes are lost when the project is closed; empty: they are stored.
    [[nodiscard]] const std::string& not_stored() const { return list_.not_stored(); }

private:
    StoredList<Spot> list_;
    std::size_t chosen_ = 0;
};

}  // namespace vesselbench
