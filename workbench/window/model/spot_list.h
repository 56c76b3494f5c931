#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "workbench/session/stored_spots.h"
#include "workbench/session/task.h"

namespace vesselbench {

/// The spots of the project in the window: read and stored on threads of their own, as soon as
/// something changes. Used by the frame's thread; no call blocks but close(), open() and the
/// destructor, which wait until what has changed is stored.
class SpotList {
public:
    /// \param wake called by another thread when update() has something to do
    explicit SpotList(std::function<void()> wake);
    ~SpotList();
    SpotList(const SpotList&) = delete;
    SpotList& operator=(const SpotList&) = delete;

    /// The spots of a project that was opened. Closes the one before.
    /// \param read_only why nothing can be stored in it; empty: it can
    void open(const std::filesystem::path& project, std::string read_only);

    /// \return why the last change is lost; empty: it is not
    std::string close();

    /// Once a frame. \return true if anything has changed
    bool update();

    /// True once those that were stored are known.
    [[nodiscard]] bool is_read() const { return !reading_->pending(); }

    [[nodiscard]] bool pending() const { return reading_->pending() || storing_->pending(); }

    [[nodiscard]] const std::vector<Spot>& all() const { return spots_; }

    /// The one that is magnified; none: there are no spots.
    [[nodiscard]] const Spot* chosen() const;

    void choose(std::size_t spot) { chosen_ = spot; }

    /// Adds a spot, "Spot 1", and chooses it.
    void add(const Vec3& point, const Vec3& normal);

    void rename(std::size_t spot, const std::string& name);
    void remove(std::size_t spot);

    /// Why changes are lost when the project is closed; empty: they are stored.
    [[nodiscard]] const std::string& not_stored() const {
        return blocked_.empty() ? failure_ : blocked_;
    }

private:
    void keep();
    std::string finish();

    std::function<void()> wake_;
    std::vector<Spot> spots_;
    std::size_t chosen_ = 0;
    std::filesystem::path project_;
    std::string blocked_;  ///< why nothing is stored
    std::string failure_;  ///< why the last change could not be stored
    bool unsaved_ = false;
    // Always there, but while what they do is waited for.
    std::optional<Task<std::vector<Spot>>> reading_;
    std::optional<Task<Nothing>> storing_;
};

}  // namespace vesselbench
