#include "workbench/window/features/review/review_feature.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/operations/table.h"
#include "workbench/review/review_page.h"
#include "workbench/window/case/edit_places.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/review/review_banner.h"
#include "workbench/window/features/review/review_words.h"

namespace vesselbench {

namespace {

std::string done_words(Verdict verdict, const ReviewedEdit* edit) {
    const std::string what = edit == nullptr ? "the whole model"
                                             : "edit " + std::to_string(edit->edit.id) + ", " +
                                                   readable(edit->operation);
    if (verdict == Verdict::Accept) return "Accepted " + what;
    return (verdict == Verdict::Reject ? "Rejected " : "Unsure of ") + what;
}

bool is_blank(const std::string& text) {
    return text.find_first_not_of(' ') == std::string::npos;
}

struct VerdictKey {
    KeyCommand key;
    Verdict verdict;
};

constexpr VerdictKey kVerdictKeys[] = {{KeyCommand::AcceptEdit, Verdict::Accept},
                                       {KeyCommand::RejectEdit, Verdict::Reject},
                                       {KeyCommand::UnsureEdit, Verdict::Unsure}};

}  // namespace

bool ReviewFeature::is_shown() const {
    if (!core_.document.is_open()) return false;
    if (core_.form()) return chosen_ && core_.form()->edit() == chosen_;
    return core_.step() == Step::Review;
}

const ReviewedEdit* ReviewFeature::chosen() const {
    if (!review_ || !chosen_) return nullptr;
    const auto found = std::ranges::find_if(
        review_->edits, [this](const ReviewedEdit& edit) { return edit.edit.id == *chosen_; });
    return found == review_->edits.end() ? nullptr : &*found;
}

void ReviewFeature::choose(EditId edit) {
    if (std::exchange(chosen_, edit) == edit) return chosen_.reset();
    const LogEntry* entry = find_entry(*core_.document.snapshot(), edit);
    const Positions places = entry == nullptr ? Positions() : places_of_edit(*entry);
    if (!places.empty()) core_.look_at(places.front());
}

void ReviewFeature::step(int by) {
    if (!review_) return;
    std::vector<EditId> list;
    for (const ReviewedEdit& edit : review_->edits) list.push_back(edit.edit.id);
    list.push_back(kWholeModel);
    const auto now = chosen_ ? std::ranges::find(list, *chosen_) : list.end();
    if (now == list.end())
        choose(by > 0 ? list.front() : list.back());
    else if (by > 0 ? now + 1 != list.end() : now != list.begin())
        choose(*(now + by));
    reveals_ = true;
}

void ReviewFeature::find_queue() {
    const auto found = std::make_shared<std::vector<QueueItem>>();
    const auto find = [found, variant = core_.document.variant()](Session& session,
                                                                  const Progress& progress) {
        const std::vector<LogEntry> log = session.log(variant);
        *found = review_queue(log, page_models(session, log, find_operation, kQueueOnly, progress),
                              find_operation);
        return make_message(MessageKind::Success,
                            found->empty() ? "Nothing stands out in the edits"
                                           : counted(found->size(), "thing") + " to look at first");
    };
    const auto keep = [this, found, changes = core_.document.snapshot_changes()] {
        queue_ = *found;
        queue_changes_ = changes;
    };
    core_.document.run({.what = "Looking for what to review first", .kind = RequestKind::Output},
                       find, keep);
}

void ReviewFeature::look_at(const QueueItem& item) {
    if (chosen_ != item.edit) choose(item.edit);
    if (item.place) core_.look_at(*item.place);
    reveals_ = true;
}

void ReviewFeature::correct() {
    const ReviewedEdit* edit = chosen();
    if (edit == nullptr) return;
    const Answer answer{.to = edit->edit, .words = "answers " + remark_of(*edit)};
    const bool rejected = is_rejected(*edit);
    core_.choose_edit(answer.to.id);
    if (rejected) answer_ = answer;
}

void ReviewFeature::applying() {
    if (answer_ && core_.form()->edit() == answer_->to.id)
        answer_->applied = true;
    else
        answer_.reset();
}

void ReviewFeature::form_dropped() {
    if (answering_edit() == nullptr) answer_.reset();
}

/// The new revision of the edit that was rejected; null: it was not changed.
const LogEntry* ReviewFeature::answering_edit() const {
    if (!answer_ || !answer_->applied || !core_.document.is_open()) return nullptr;
    const LogEntry* entry = find_entry(*core_.document.snapshot(), answer_->to.id);
    return entry != nullptr && entry->edit.edit.revision > answer_->to.revision ? entry : nullptr;
}

void ReviewFeature::note_answer() {
    const LogEntry* entry = answering_edit();
    if (entry == nullptr || !core_.document.can(RequestKind::History)) return;
    const std::string before = entry->edit.note.empty() ? "" : entry->edit.note + "; ";
    core_.document.set_note(entry->edit.edit, before + answer_->words);
    answer_.reset();
}

float ReviewFeature::banner(PanelContext& context, const ScreenRect& place) {
    const ReviewedEdit* edit = core_.form() && is_shown() ? chosen() : nullptr;
    return edit != nullptr && is_rejected(*edit) ? draw_review_banner(context, *edit, place) : 0.0F;
}

// --- the draft

bool ReviewFeature::has_draft(EditId edit) const {
    const auto found = drafts_.find(edit);
    if (found == drafts_.end()) return false;
    const VerdictDraft& draft = found->second;
    return !is_blank(draft.comment) || !draft.pins.empty() || !draft.distances.empty();
}

std::string ReviewFeature::why_not_mark() const {
    if (chosen() == nullptr) return "choose an edit";
    return asks_who() ? "say who you are first" : "";
}

void ReviewFeature::switch_tool(ClickTool tool) {
    const bool ends = core_.view.tool == tool;
    if (ends || why_not_mark().empty()) core_.view.tool = ends ? ClickTool::None : tool;
}

void ReviewFeature::mark(const Vec3& place) {
    if (!why_not_mark().empty()) return;
    if (core_.view.tool == ClickTool::ReviewPin) {
        want_field("review.draft.pin." + std::to_string(draft().pins.size()));
        draft().pins.push_back({.place = place, .text = {}});
    } else if (first_) {
        want_field("review.draft.distance." + std::to_string(draft().distances.size()));
        draft().distances.push_back(distance_between(*first_, place));
        first_.reset();
    } else {
        first_ = place;
    }
}

bool ReviewFeature::takes_keyboard(const std::string& name) {
    if (wanted_field_ != name) return false;
    wanted_field_.clear();
    return true;
}

std::string ReviewFeature::why_not(Verdict verdict) const {
    if (!is_judging()) return "choose an edit";
    if (asks_who()) return "say who you are first";
    const auto draft = drafts_.find(*chosen_);
    const std::string missing =
        why_incomplete(draft == drafts_.end() ? VerdictDraft{} : draft->second, verdict);
    if (!missing.empty()) return missing;
    if (entering_ || reading_.pending()) return "a verdict is being entered";
    return core_.document.why_not(RequestKind::History);
}

void ReviewFeature::give(Verdict verdict) {
    if (!why_not(verdict).empty()) return;
    const Reviewer reviewer{core_.settings.reviewer, core_.settings.reviewer_role};
    const std::string done = done_words(verdict, chosen());
    const auto entered = [this, id = *chosen_, given = draft()] {
        drafts_[id] = rest_of(std::move(drafts_[id]), given);
    };
    entering_ = true;
    if (const ReviewedEdit* edit = chosen())
        enter(
            "Entering a verdict",
            [said = verdict_of(draft(), verdict, *edit, reviewer.name), reviewer, done](
                Session& session, const Progress&) {
                static_cast<void>(enter_verdict(session, reviewer, said));
                return make_message(MessageKind::Success, done);
            },
            entered);
    else
        enter(
            "Entering a verdict",
            [seen = review_, comment = draft().comment, verdict, reviewer, done](Session& session,
                                                                                 const Progress&) {
                static_cast<void>(enter_overall(session, reviewer, *seen, verdict, comment));
                return make_message(MessageKind::Success, done);
            },
            entered);
}

/// A rejection without its reason asks for it.
void ReviewFeature::give_by_key(Verdict verdict) {
    if (is_judging() && !asks_who() && verdict == Verdict::Reject && is_blank(draft().comment))
        return want_field("review.comment");
    give(verdict);
}

void ReviewFeature::switch_blink() {
    const ReviewedEdit* edit = chosen();
    if (blink_.edit() || edit == nullptr) return blink_.stop();
    blink_.start(edit->edit.id);
}

void ReviewFeature::keys(PanelContext& c) {
    if (!is_shown() || core_.form() || !review_) return;
    const KeyCommands& keys = c.shown.keys;
    if (keys.has(KeyCommand::NextEdit)) step(1);
    if (keys.has(KeyCommand::PreviousEdit)) step(-1);
    for (const VerdictKey& key : kVerdictKeys)
        if (keys.has(key.key)) give_by_key(key.verdict);
    if (keys.has(KeyCommand::CommentEdit) && is_judging()) want_field("review.comment");
    if (keys.has(KeyCommand::PlacePin)) switch_tool(ClickTool::ReviewPin);
    if (keys.has(KeyCommand::PlaceDistance)) switch_tool(ClickTool::ReviewDistance);
    if (keys.has(KeyCommand::BlinkEdit)) switch_blink();
}

// --- who judges

void ReviewFeature::ask_who() {
    who = {core_.settings.reviewer, core_.settings.reviewer_role};
    asks_who_ = true;
}

void ReviewFeature::keep_who() {
    if (is_blank(who.name)) return;
    core_.settings.reviewer = who.name;
    core_.settings.reviewer_role = who.role;
    core_.settings.save_soon();
    asks_who_ = false;
}

// --- events

/// What belongs to the chosen edit ends with it.
void ReviewFeature::end_tools() {
    const ReviewedEdit* edit = is_shown() && !core_.form() ? chosen() : nullptr;
    if (is_reviewing(core_.view.tool) && edit == nullptr) core_.view.tool = ClickTool::None;
    const std::pair now(core_.view.tool, core_.document.scene_changes());
    if (std::exchange(marked_with_, now) != now) first_.reset();
    if (blink_.edit() && (edit == nullptr || edit->edit.id != *blink_.edit())) blink_.stop();
    blink_.update();
}

void ReviewFeature::read() {
    const Version now{core_.document.opened(), core_.document.snapshot_changes(), entered_};
    // Beside its step, the rail marks what is rejected.
    const bool wanted = is_shown() || !review_ || review_->files > 0;
    if (!core_.document.is_open() || !wanted || read_ == now) return;
    read_ = now;
    reading_ = core_.document.runner()->submit(
        [variant = core_.document.variant()](Session& session, const Progress&) {
            return review_of(session, variant);
        },
        "review");
}

bool ReviewFeature::update() {
    note_answer();
    if (queue_changes_ != core_.document.snapshot_changes()) queue_.reset();
    if (!core_.document.activity()) entering_ = false;
    end_tools();
    read();
    if (!reading_.poll()) return false;
    take_review(reading_.newest());
    return true;
}

void ReviewFeature::take_review(std::shared_ptr<const Review> review) {
    review_ = std::move(review);
    rejected_.clear();
    for (std::size_t i = 0; review_ && i < review_->edits.size(); ++i)
        if (is_rejected(review_->edits[i])) rejected_[review_->edits[i].edit] = i;
}

const ReviewedEdit* ReviewFeature::rejected(const EditRef& edit) const {
    const auto found = rejected_.find(edit);
    return found == rejected_.end() ? nullptr : &review_->edits[found->second];
}

void ReviewFeature::case_closed() {
    blink_.stop();
    reading_ = {};
    take_review(nullptr);
    read_.reset();
    chosen_.reset();
    answer_.reset();
    queue_.reset();
    drafts_.clear();
    entering_ = false;
}

void ReviewFeature::file_chosen(FileQuestion question, const std::filesystem::path& file) {
    if (question == FileQuestion::ReviewPage) write_page(file);
    if (question == FileQuestion::Verdicts) import(file);
}

/// Verdicts are read again afterwards.
void ReviewFeature::enter(const std::string& what,
                          std::function<Message(Session&, const Progress&)> work,
                          std::function<void()> then) {
    core_.document.run({.what = what, .kind = RequestKind::History}, std::move(work),
                       [this, then = std::move(then)] {
                           ++entered_;
                           if (then) then();
                       });
}

void ReviewFeature::write_page(const std::filesystem::path& file) {
    core_.document.write_text(
        file, {.what = "Writing the review page", .kind = RequestKind::Output},
        [variant = core_.document.variant()](Session& session, const Progress& progress) {
            return review_page(session, variant, find_operation, PageImages::Contours, progress)
                .html;
        });
}

void ReviewFeature::import(const std::filesystem::path& file) {
    enter("Importing verdicts", [file](Session& session, const Progress&) {
        const ImportedVerdicts imported = import_verdicts(session, file);
        const auto kind =
            imported.known || imported.outdated > 0 ? MessageKind::Remark : MessageKind::Success;
        return make_message(kind, file.filename().string() + ": " + imported_words(imported));
    });
}

}  // namespace vesselbench
