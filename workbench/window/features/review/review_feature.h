#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "workbench/review/page_queue.h"
#include "workbench/review/review.h"
#include "workbench/review/verdict_draft.h"
#include "workbench/review/verdict_import.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/review/edit_blink.h"

namespace vesselbench {

/// Chosen in place of an edit to judge the whole model; no edit has it.
inline constexpr EditId kWholeModel = 0;

/// What reviewers say of the shown variant's edits: read when a case is opened, and after each
/// change while the review step is shown or once verdicts were entered; exchanged as files, and
/// entered here. All of it runs on the case's thread.
class ReviewFeature : public Feature {
public:
    explicit ReviewFeature(Core& core) : core_(core), blink_(core) {}

    /// As of the last reading; null: it is not known.
    [[nodiscard]] const std::shared_ptr<const Review>& review() const { return review_; }

    /// An edit that somebody rejects; null: nobody does, or it is not known.
    [[nodiscard]] const ReviewedEdit* rejected(const EditRef& edit) const;

    /// Why it could not be read; empty: it could.
    [[nodiscard]] const std::string& problem() const { return reading_.problem(); }

    /// True while the step, or the form of the chosen edit, is shown.
    [[nodiscard]] bool is_shown() const;

    // --- what to look at first

    /// The best reason first; none: it was not looked for since the edits have changed.
    [[nodiscard]] const std::optional<std::vector<QueueItem>>& queue() const { return queue_; }

    /// Looks for it, which reads the model after each edit.
    void find_queue();

    /// Chooses the item's edit, and looks at its place.
    void look_at(const QueueItem& item);

    /// True once after look_at(): the list scrolls to the chosen edit.
    [[nodiscard]] bool take_reveals() { return std::exchange(reveals_, false); }

    // --- what is judged

    /// The edit that is judged. Null: none, the whole model, or the model has it no longer.
    [[nodiscard]] const ReviewedEdit* chosen() const;

    /// True if the whole model is judged.
    [[nodiscard]] bool judges_whole() const { return review_ && chosen_ == kWholeModel; }

    /// Chooses an edit or the whole model, or none if it is chosen; looks at an edit's place.
    void choose(EditId edit);

    /// Chooses the next one of the list, whose last one is the whole model. \param by 1 or -1
    void step(int by);

    /// Opens the form of the chosen edit. If it was rejected, and is changed there, the note of its
    /// new revision says what it answers.
    void correct();

    /// Shows the models before and after the chosen edit in turn, until it is called again.
    void switch_blink();

    [[nodiscard]] const EditBlink& blink() const { return blink_; }

    // --- the verdict on it, until it is entered

    /// Kept until the case is closed. \pre something is judged
    [[nodiscard]] VerdictDraft& draft() { return drafts_[chosen_.value()]; }

    /// True if something is written or marked for an edit, or the whole model.
    [[nodiscard]] bool has_draft(EditId edit) const;

    /// Lets clicks on the surface place pins or distances on the chosen edit, or ends that.
    void switch_tool(ClickTool tool);

    /// Why it cannot; empty: it can.
    [[nodiscard]] std::string why_not_mark() const;

    /// A place that was clicked [mm]: a pin, or an end of a distance.
    void mark(const Vec3& place);

    /// The end of a distance that waits for its other end.
    [[nodiscard]] const std::optional<Vec3>& first_point() const { return first_; }

    /// Why such a verdict cannot be entered now; empty: it can.
    [[nodiscard]] std::string why_not(Verdict verdict) const;

    /// Enters the draft; ignored if why_not() says why.
    void give(Verdict verdict);

    /// A field of the panel gets the keyboard when it is drawn next.
    void want_field(const std::string& name) { wanted_field_ = name; }

    /// True once after want_field().
    [[nodiscard]] bool takes_keyboard(const std::string& name);

    // --- who judges

    /// True until the name is known, and while it is changed.
    [[nodiscard]] bool asks_who() const { return asks_who_ || core_.settings.reviewer.empty(); }

    void ask_who();

    Reviewer who;  ///< the answer, while it is written

    /// Keeps the answer, for this and other cases; ignored without a name.
    void keep_who();

    // --- events

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return reading_.pending(); }

    void keys(PanelContext& context) override;

    void case_opened() override { case_closed(); }

    void case_closed() override;

    void applying() override;
    void form_dropped() override;

    [[nodiscard]] float banner(PanelContext& context, const ScreenRect& place) override;

    void file_chosen(FileQuestion question, const std::filesystem::path& file) override;

private:
    /// What a reading depends on: cases, changes of the edits and the variant, changes of verdicts.
    using Version = std::tuple<int, int, int>;

    /// What a corrected edit answers.
    struct Answer {
        EditRef to;         ///< the edit that was rejected
        std::string words;  ///< "answers A. Kern: too smooth"
        bool applied = false;
    };

    void take_review(std::shared_ptr<const Review> review);
    [[nodiscard]] const LogEntry* answering_edit() const;
    void note_answer();

    [[nodiscard]] bool is_judging() const { return chosen() != nullptr || judges_whole(); }

    void give_by_key(Verdict verdict);
    void read();
    void end_tools();
    void enter(const std::string& what, std::function<Message(Session&, const Progress&)> work,
               std::function<void()> then = {});
    void write_page(const std::filesystem::path& file);
    void import(const std::filesystem::path& file);

    Core& core_;
    Task<Review> reading_;
    std::shared_ptr<const Review> review_;
    std::map<EditRef, std::size_t> rejected_;  ///< of its edits
    std::optional<Version> read_;
    int entered_ = 0;  ///< counts changes of verdicts
    std::optional<EditId> chosen_;
    std::map<EditId, VerdictDraft> drafts_;
    bool entering_ = false;  ///< a draft
    std::optional<Vec3> first_;
    std::pair<ClickTool, int> marked_with_;  ///< tool, and the document's scene changes
    std::string wanted_field_;
    EditBlink blink_;
    std::optional<Answer> answer_;
    std::optional<std::vector<QueueItem>> queue_;
    int queue_changes_ = 0;  ///< the document's snapshot changes that it is of
    bool reveals_ = false;
    bool asks_who_ = false;
};

}  // namespace vesselbench
