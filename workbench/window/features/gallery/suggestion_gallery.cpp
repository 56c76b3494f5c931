#include "workbench/window/features/gallery/suggestion_gallery.h"

#include <algorithm>
#include <utility>

#include "workbench/case/arguments.h"

namespace vesselbench {

namespace {

void search_presets(const Operation& operation, const Scene& scene, const Arguments& given,
                    const TaskTurn<GalleryAnswer>& turn) {
    GalleryAnswer answer;
    const auto receive = [&](PresetSuggestion found) {
        answer.found.push_back(std::make_shared<const PresetSuggestion>(std::move(found)));
        turn.send(answer);
    };
    suggest_presets(operation, scene, given, receive, turn.progress);
}

}  // namespace

SuggestionGallery::SuggestionGallery(const std::function<void()>& wake)
    : spots(wake), searches_(wake) {}

// --- following the form

bool SuggestionGallery::update(const LiveSmoothing::Followed& followed, const LiveSmoothing& live) {
    const bool spotted = spots.update();
    possible_ = live.can_follow();
    if (!possible_) {
        show(GalleryMode::Off);
        drop();
    } else if (mode_ != GalleryMode::Off) {
        take_original(followed.document.current());
        if (followed.form->valid()) ask(followed, live);
    }
    return searches_.poll() || spotted;
}

void SuggestionGallery::show(GalleryMode mode) {
    if (!possible_) mode = GalleryMode::Off;
    if (mode_ == mode) return;
    mode_ = mode;
    picks_ = false;
    if (mode != GalleryMode::Off || !searches_.pending()) return;
    searches_.drop();
    asked_ = {};
}

/// The model or the form is gone.
void SuggestionGallery::drop() {
    original_.reset();
    if (std::exchange(asked_, {}) != Asked{} || searches_.newest()) searches_.forget();
}

void SuggestionGallery::take_original(const Scene* scene) {
    if (scene == nullptr || !scene->surface) return original_.reset();
    if (original_ && original_->positions == scene->surface->positions) return;
    original_ = std::make_shared<const Surface>(*scene->surface);
}

void SuggestionGallery::ask(const LiveSmoothing::Followed& followed, const LiveSmoothing& live) {
    Asked now{live.base(), without_filter_values(followed.form->arguments())};
    if (now == asked_) return;
    asked_ = std::move(now);
    searches_.forget();  // the old ones suit another model, or other arguments
    searches_.start([scene = *followed.document.current(), &operation = followed.form->operation(),
                     given = asked_.given](const TaskTurn<GalleryAnswer>& turn) {
        search_presets(operation, scene, given, turn);
    });
}

std::shared_ptr<const PresetSuggestion> SuggestionGallery::suggestion(std::size_t i) const {
    const auto& answer = searches_.newest();
    return answer && i < answer->found.size() ? answer->found[i] : nullptr;
}

std::vector<FieldText> SuggestionGallery::texts(const OperationForm& form,
                                                const PresetSuggestion& suggestion) {
    std::vector<FieldText> texts;
    const auto& values = suggestion.arguments.values();
    for (const FormField& field : form.fields()) {
        const std::string& name = field.parameter->name;
        if (const auto value = values.find(name); value != values.end())
            texts.push_back({name, to_text(value->second)});
        else if (std::ranges::count(filter_values(), name) > 0)
            texts.push_back({name, ""});
    }
    return texts;
}

/// It names the filter, which was decided for all of them.
void SuggestionGallery::took(const OperationForm& form) {
    if (asked_ != Asked{} && form.valid()) asked_.given = without_filter_values(form.arguments());
}

void SuggestionGallery::add_spot(const Vec3& point, const Vec3& normal) {
    spots.add(point, normal);
    picks_ = false;
}

}  // namespace vesselbench
