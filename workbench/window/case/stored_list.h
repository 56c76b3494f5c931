#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "workbench/session/task.h"

namespace vesselbench {

/// Where a list is kept in a project.
template <class Item>
struct ListStore {
    const char* what;  ///< "spots"
    std::vector<Item> (*read)(const std::filesystem::path& project);
    void (*store)(const std::filesystem::path& project, const std::vector<Item>& items);
};

/// A list that a project keeps beside its history: read and stored on threads of its own, as soon
/// as something changes. Used by the frame's thread; no call blocks but close(), open() and the
/// destructor, which wait until what has changed is stored.
template <class Item>
class StoredList {
public:
    /// \param wake called by another thread when update() has something to do
    StoredList(std::function<void()> wake, ListStore<Item> file)
        : wake_(std::move(wake)), file_(file) {
        reading_.emplace(wake_);
        storing_.emplace(wake_);
    }

    ~StoredList() { finish(); }

    StoredList(const StoredList&) = delete;
    StoredList& operator=(const StoredList&) = delete;

    /// The list of a project that was opened. Closes the one before.
    /// \param read_only why nothing can be stored in it; empty: it can
    void open(const std::filesystem::path& project, std::string read_only) {
        close();
        project_ = project;
        blocked_ = std::move(read_only);
        read_ = false;
        reading_->start([project, read = file_.read](const Progress&) { return read(project); });
    }

    /// \return why the last change is lost; empty: it is not
    std::string close() {
        std::string lost = finish();
        reading_.emplace(wake_);
        storing_.emplace(wake_);
        project_.clear();
        blocked_.clear();
        failure_.clear();
        items_.clear();
        read_ = true;
        return lost;
    }

    /// Once a frame. \return true if anything has changed
    bool update() {
        const bool read = reading_->poll(), stored = storing_->poll();
        if (auto items = reading_->take()) put_first(std::move(*items));
        // What cannot be read is not written over.
        if (read && !reading_->problem().empty())
            blocked_ =
                std::string("the stored ") + file_.what + " cannot be read: " + reading_->problem();
        if (stored) failure_ = storing_->problem();
        if (stored && failure_.empty() && !storing_->pending()) unsaved_ = false;
        return read || stored;
    }

    /// True once those that were stored are known.
    [[nodiscard]] bool is_read() const { return !reading_->pending(); }

    [[nodiscard]] bool pending() const { return reading_->pending() || storing_->pending(); }

    [[nodiscard]] const std::vector<Item>& all() const { return items_; }

    /// \param edit called with the items, which are stored then
    template <class Edit>
    void change(Edit edit) {
        edit(items_);
        keep();
    }

    /// Why changes are lost when the project is closed; empty: they are stored.
    [[nodiscard]] const std::string& not_stored() const {
        return blocked_.empty() ? failure_ : blocked_;
    }

private:
    /// Items may have been added before the stored ones were known.
    void put_first(std::vector<Item> stored) {
        items_.insert(items_.begin(), std::make_move_iterator(stored.begin()),
                      std::make_move_iterator(stored.end()));
        read_ = true;
        if (unsaved_) keep();
    }

    void keep() {
        if (project_.empty() || !blocked_.empty()) return;
        unsaved_ = true;
        if (!read_) return;
        storing_->start_after(
            [project = project_, items = items_, store = file_.store](const Progress&) {
                store(project, items);
                return Nothing{};
            });
    }

    /// What was asked for last may still wait. \return why it is lost; empty: it is not
    std::string finish() {
        reading_.reset();
        storing_.reset();
        if (!std::exchange(unsaved_, false) || !blocked_.empty()) return "";
        try {
            if (!read_) {
                std::vector<Item> stored = file_.read(project_);
                stored.insert(stored.end(), items_.begin(), items_.end());
                items_ = std::move(stored);
            }
            file_.store(project_, items_);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }

    std::function<void()> wake_;
    ListStore<Item> file_;
    std::vector<Item> items_;
    std::filesystem::path project_;
    std::string blocked_;  ///< why nothing is stored
    std::string failure_;  ///< why the last change could not be stored
    bool read_ = true;     ///< the stored ones are in the list
    bool unsaved_ = false;
    // Always there, but while what they do is waited for.
    std::optional<Task<std::vector<Item>>> reading_;
    std::optional<Task<Nothing>> storing_;
};

}  // namespace vesselbench
