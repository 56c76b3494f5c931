#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "workbench/window/case/history_tree.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/surface_places.h"
#include "workbench/window/case/unit_question.h"
#include "workbench/window/core/feature_list.h"
#include "workbench/window/core/file_question.h"
#include "workbench/window/core/settings.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/form/form_desk.h"
#include "workbench/window/form/recipe_draft.h"

namespace vesselbench {

/// What every feature of the window may use: the document and its open form, the settings, what the
/// view shows, and the other features, which hear from it what happens.
class Core : public FormDesk, private FormListener {
public:
    Core(const DocumentOptions& options, Settings settings);

    /// Collects what has ended; once a frame. \return true if something shown has changed
    bool update();

    /// True while something runs whose end changes what is shown.
    [[nodiscard]] bool pending() const;

    Settings settings;
    ViewChoice view;
    RecipeDraft recipe;  ///< that is about to be prepared
    FeatureList features;

    template <class Type>
    [[nodiscard]] Type& get() const {
        return features.get<Type>();
    }

    /// Called by any thread when a frame should be drawn; may be empty.
    [[nodiscard]] const std::function<void()>& wake() const { return wake_; }

    // --- cases

    /// Opens a file or folder that the user chose, or a bundled one, whose project goes to the
    /// documents folder.
    void open(const std::filesystem::path& path);
    void open_bundled(const std::filesystem::path& path);
    void open_phantom(const std::string& name);
    void close();

    // --- lists, current as of the last update

    [[nodiscard]] const std::vector<RailStep>& rail() const { return rail_; }

    [[nodiscard]] const HistoryTree& history() const { return history_; }

    /// What the user has to say about the unit of a file; none: nothing.
    [[nodiscard]] const std::optional<UnitQuestion>& unit_question() const {
        return unit_question_;
    }

    /// Reads the file of the question in this unit: "cm".
    void answer_unit(const std::string& unit);

    /// True if an edit has loaded the image and can be changed.
    [[nodiscard]] bool can_add_mask() const;

    /// Shows the form of the edit that loaded the image, and asks for a mask's file.
    void ask_for_mask();

    /// The mouse is over an edit, in the rail or in the view: it is lit up in the next frame.
    void point_at_edit(EditId edit) { next_pointed_ = edit; }

    [[nodiscard]] const std::optional<EditId>& pointed_edit() const { return pointed_; }

    // --- the view

    /// A feature shows something beside the model or in its place: others end what they show there.
    void claim_view(const Feature& by);

    /// Moves the slices and the view to a place [mm].
    /// \param outward unit normal of the surface there, from whose side it is seen; zero: unknown
    void look_at(const Vec3& place, const Vec3& outward = Vec3::Zero());

    /// The place of the last look_at(), which is marked until a form or a case is left.
    [[nodiscard]] const std::optional<Vec3>& looked_at() const { return looked_at_; }

    /// The normal of the last look_at().
    [[nodiscard]] const Vec3& looked_from() const { return looked_from_; }

    /// Counts calls of look_at().
    [[nodiscard]] int looks() const { return looks_; }

    /// Brings all of the model into view.
    void frame_model() { ++frames_; }

    /// Counts calls of frame_model().
    [[nodiscard]] int frames() const { return frames_; }

    /// The places of the shown surface; vessel ends only if the form wants them.
    [[nodiscard]] const SurfacePlaces& surface_places() const { return places_; }

    [[nodiscard]] bool searches_places() const { return search_.pending(); }

    /// True if clicks on the model are for a tool, and for nothing else; those in slices measure
    /// distances and else move the cross.
    [[nodiscard]] bool has_click_tool() const {
        return view.tool != ClickTool::None && armed().empty();
    }

    // --- questions for a file

    [[nodiscard]] FileQuestion question() const { return question_; }

    [[nodiscard]] const std::string& asked_parameter() const { return asked_parameter_; }

    void ask(FileQuestion question, const std::string& parameter = {});

    /// The file that was asked for; several where takes_several() allows them: each by itself.
    void answer(const std::vector<std::filesystem::path>& files);

    void answer(const std::filesystem::path& file) { answer(std::vector{file}); }

private:
    void for_listeners(const Listen& call) override;

    [[nodiscard]] bool listeners_allow_apply() const override;

    void form_dropped() override { looked_at_.reset(); }

    void take_case();
    void renew_lists();
    void answer(FileQuestion question, const std::filesystem::path& file);
    void save_recipe(const std::filesystem::path& file, const std::string& text);
    [[nodiscard]] bool update_places();
    void search_places(const Scene* scene, bool tips);

    std::function<void()> wake_;
    std::vector<RailStep> rail_ = empty_rail();
    std::optional<UnitQuestion> unit_question_;
    HistoryTree history_;
    int seen_snapshots_ = 0, seen_opened_ = 0;
    FileQuestion question_ = FileQuestion::None;
    std::string asked_parameter_;
    Task<SurfacePlaces> search_;
    SurfacePlaces places_;
    int searched_scenes_ = -1;  ///< the document's scene changes at the last search
    bool searched_tips_ = false;
    std::optional<EditId> pointed_, next_pointed_;
    std::optional<Vec3> looked_at_;
    Vec3 looked_from_ = Vec3::Zero();
    int looks_ = 0, frames_ = 0;
};

}  // namespace vesselbench
