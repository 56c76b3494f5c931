#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "geometry/kernel/stopwatch.h"
#include "workbench/case/operation.h"
#include "workbench/window/case/answerer.h"

namespace vesselbench {

/// What all forms have in common whose outcome the view follows live, without an edit. Used by the
/// frame's thread.
/// \tparam Model has the `question` that it answers, and a `state` that says whether it is `whole`
/// \tparam Key distinguishes questions: an equal one is not asked again
template <class Question, class Model, class Key>
class LiveForm {
public:
    /// True if the form is of an operation that can be followed.
    [[nodiscard]] bool has_form() const { return operation_ != nullptr; }

    /// Why the form cannot be followed; empty: it can.
    [[nodiscard]] const std::string& why_not() const { return why_not_; }

    [[nodiscard]] bool can_follow() const { return has_form() && why_not_.empty(); }

    /// Begins or ends to show what the form says.
    void follow(bool on) {
        if (on_ == on || (on && !can_follow())) return;
        on_ = on;
        asked_.reset();
        if (!on) forget_models();
    }

    [[nodiscard]] bool follows() const { return on_; }

    /// What the view shows instead of the document's scene; null: nothing.
    [[nodiscard]] const std::shared_ptr<const Model>& shown() const { return shown_; }

    /// The last one, also while something else is shown; null: none.
    [[nodiscard]] const std::shared_ptr<const Model>& model() const { return models_.newest(); }

    /// True while shown() does not answer the form as it is now, or not wholly.
    [[nodiscard]] bool outdated() const {
        return shown_ && (shown_->question != question_ || !shown_->state.whole);
    }

    /// Why the form cannot be answered; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return models_.problem(); }

    [[nodiscard]] bool pending() const { return on_ && models_.pending(); }

    /// A drag begins, which is followed.
    void begin_drag() {
        on_before_drag_ = on_;
        follow(true);
    }

    /// The drag is cancelled: what was not followed before it is no longer.
    void cancel_drag() {
        if (!on_before_drag_) follow(false);
    }

protected:
    using Models = AnswerTask<Question, Model>;

    LiveForm(std::function<void()> wake, typename Models::Maker make)
        : models_(std::move(wake), std::move(make)) {}

    /// \param operation that can be followed; null: none \return true if it is another one
    bool take_operation(const Operation* operation) {
        const bool another = std::exchange(operation_, operation) != operation;
        if (another || operation == nullptr) follow(false);
        if (operation == nullptr) why_not_.clear();
        return another;
    }

    void take_reason(std::string why_not) {
        why_not_ = std::move(why_not);
        if (!why_not_.empty()) follow(false);
    }

    /// Another model, or image, has another number.
    void take_new_base() {
        ++base_;
        forget_models();
    }

    /// Models are taken as they come. \return true if there is a newer one, or a problem
    bool take_models() { return models_.poll(); }

    /// Asks unless that was asked already, or what the last question was asked for is about to
    /// come: values that change in every frame would otherwise keep all of it from being seen.
    /// \param answered whether it has come
    template <class Make>
    void ask(const Key& key, bool answered, const Make& question) {
        const bool waits = models_.pending() && !answered && since_asked_.seconds() < kPatience;
        if (asked_ == key || waits) return;
        asked_ = key;
        since_asked_ = {};
        question_ = vesselbench::ask(models_, question());
    }

    /// \return true if another one is shown
    bool show(bool seen) {
        const auto before = std::exchange(shown_, on_ && seen ? models_.newest() : nullptr);
        return before != shown_;
    }

    [[nodiscard]] int base_number() const { return base_; }

    /// True if the newest model answers the last question.
    [[nodiscard]] bool is_answered() const { return model() && model()->question == question_; }

private:
    static constexpr double kPatience = 0.25;  ///< with a question, before a newer one ends it [s]

    void forget_models() {
        shown_.reset();
        models_.forget();
    }

    Models models_;
    std::shared_ptr<const Model> shown_;
    bool on_ = false, on_before_drag_ = false;
    std::string why_not_;
    int base_ = 0;
    const Operation* operation_ = nullptr;
    std::optional<Key> asked_;
    std::uint64_t question_ = 0;
    Stopwatch since_asked_;
};

}  // namespace vesselbench
