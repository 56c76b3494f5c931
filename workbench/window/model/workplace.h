#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "workbench/window/model/automatic_values.h"
#include "workbench/window/model/brush_form.h"
#include "workbench/window/model/comparison.h"
#include "workbench/window/model/crop_handles.h"
#include "workbench/window/model/document.h"
#include "workbench/window/model/field_text.h"
#include "workbench/window/model/history_tree.h"
#include "workbench/window/model/image_slices.h"
#include "workbench/window/model/label_list.h"
#include "workbench/window/model/live_extraction.h"
#include "workbench/window/model/live_smoothing.h"
#include "workbench/window/model/measure_list.h"
#include "workbench/window/model/openings_model.h"
#include "workbench/window/model/operation_form.h"
#include "workbench/window/model/pick_target.h"
#include "workbench/window/model/quality_analysis.h"
#include "workbench/window/model/rail.h"
#include "workbench/window/model/recipe_draft.h"
#include "workbench/window/model/settings.h"
#include "workbench/window/model/suggestion_gallery.h"
#include "workbench/window/model/surface_places.h"
#include "workbench/window/model/unit_question.h"
#include "workbench/window/model/view_data.h"
#include "workbench/window/model/worst_places.h"

namespace vesselbench {

/// What a file is asked for.
enum class FileQuestion { None, Open, SaveCopy, Export, Parameter, Picture, Measures, SaveRecipe };

/// Everything the window is about, without drawing: the document, what the user has chosen and
/// typed, and the lists that panels show.
class Workplace {
public:
    /// \param live device of live smoothing
    Workplace(DocumentOptions options, Settings settings, const LiveDevice& live = {});

    /// Collects what has ended; once a frame. \return true if something shown has changed
    bool update();

    Document document;
    Settings settings;
    ViewChoice view;
    MeasureList measures;
    RecipeDraft recipe;  ///< that is about to be prepared

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

    // --- the operation panel

    [[nodiscard]] std::optional<OperationForm>& form() { return form_; }

    [[nodiscard]] const std::optional<OperationForm>& form() const { return form_; }

    [[nodiscard]] Step step() const { return step_; }

    /// Shows the operations of a step.
    void choose_step(Step step);

    /// Shows the form of an operation, and the model that its edit will run on. The edit will
    /// belong to the given step if the operation is allowed there, else to its usual step. \throw
    /// UsageError if there is none of this name
    void choose(const std::string& operation, std::optional<Step> step = {});

    /// Shows the form of an edit of the current state, and the model that it runs on. Ignored if
    /// the operation is of another version.
    void choose_edit(EditId edit);

    /// The field of a parameter gets the keyboard in the next frame that draws it; empty: none.
    void want_field(const std::string& parameter) { wanted_field_ = parameter; }

    [[nodiscard]] const std::string& wanted_field() const { return wanted_field_; }

    /// Moves the slices and the view to a place [mm].
    /// \param outward unit normal of the surface there, from whose side it is seen; zero: unknown
    void look_at(const Vec3& place, const Vec3& outward = Vec3::Zero());

    /// Looks at the next worst place of what the colours show; back with -1. Says why if it cannot.
    void look_at_worst(int steps);

    /// The place of the last look_at(), which is marked until a form or a case is left.
    [[nodiscard]] const std::optional<Vec3>& looked_at() const { return looked_at_; }

    /// The normal of the last look_at().
    [[nodiscard]] const Vec3& looked_from() const { return looked_from_; }

    /// Counts calls of look_at().
    [[nodiscard]] int looks() const { return looks_; }

    /// True while what fields show is not known: automatic values, labels.
    [[nodiscard]] bool finds_field_values() const {
        return automatic_.pending() || labels_.pending();
    }

    /// The labels that the form may take.
    [[nodiscard]] const LabelList& labels() const { return labels_; }

    void set_field(const std::string& parameter, const std::string& text);
    void reset_form();

    /// Closes the form and drops its preview: the newest model is shown.
    void leave_form();

    [[nodiscard]] bool can_apply() const;
    void preview();
    /// Enters the preview if it is of what the form says, else runs the form.
    void apply();

    // --- the brush

    /// True if the form is of a brush that can paint on the shown surface now; not while clicks
    /// are for a parameter.
    [[nodiscard]] bool can_paint() const;

    /// True while a stroke of the form's brush is drawn.
    [[nodiscard]] bool is_painting() const;

    /// The form's brush, which later forms of brushes take over.
    [[nodiscard]] BrushTip tip() const;
    void set_tip(const BrushTip& tip);

    void begin_stroke(StrokeKeys keys);

    /// The form's command line.
    [[nodiscard]] std::string command() const;

    // --- picking in the view

    /// Lets clicks in the view give a value to a parameter of the form; an armed one is disarmed.
    /// Drops a preview, whose surface is not what the operation will run on.
    void arm(const std::string& parameter);

    void disarm() { armed_.clear(); }

    /// The parameter that clicks are for; empty: none.
    [[nodiscard]] const std::string& armed() const { return armed_; }

    /// What a click means now; none unless a parameter is armed.
    [[nodiscard]] std::optional<PickTarget> armed_target() const;

    /// Fills in the armed parameter, and disarms it when its value is complete. Ignored while the
    /// view shows another model than the edit will run on.
    void pick(const Vec3& point);

    /// Adds a label to the armed parameter, or removes it.
    void pick_label(int label);

    /// The places of the shown surface; vessel ends only if the form wants them.
    [[nodiscard]] const SurfacePlaces& surface_places() const { return places_; }

    [[nodiscard]] bool searches_places() const { return search_.pending(); }

    // --- measuring

    /// True if clicks on the model and in slices measure, and are for nothing else.
    [[nodiscard]] bool is_measuring() const {
        return view.tool != MeasureTool::None && armed_.empty();
    }

    /// What a measure that is made now is of. \param on Surface also for a preview
    [[nodiscard]] MeasuredModel measured_model(MeasuredOn on) const;

    // --- the image

    /// Slices of the shown scene's image.
    [[nodiscard]] ImageSlices& slices() { return slices_; }

    [[nodiscard]] const ImageSlices& slices() const { return slices_; }

    // --- comparing

    /// None while nothing is compared.
    [[nodiscard]] std::optional<Comparison>& comparison() { return comparison_; }

    [[nodiscard]] const std::optional<Comparison>& comparison() const { return comparison_; }

    /// Compares a state with the shown one, in the mode of the last time; the same state again ends
    /// it.
    void compare(StateId reference);

    void stop_comparing();

    /// True while a comparison is being read or measured.
    [[nodiscard]] bool is_comparing() const { return comparison_ && comparison_->pending(); }

    // --- handles in the view

    /// The box that a form which crops offers; none: it offers none [mm].
    [[nodiscard]] const std::optional<Bounds>& offered_box() const { return offered_.bounds(); }

    /// Begins to drag a handle of the form's.
    void begin_drag();

    /// Fills in fields while a handle is dragged.
    void drag(const std::vector<FieldText>& texts);

    void end_drag();

    /// Ends a drag, and brings back the texts from before it.
    void cancel_drag();

    /// Brings back the texts from before the last drag. \return false if it changed nothing, or
    /// something was entered since
    bool take_back_drag();

    /// The form when the drag began; none: nothing is dragged.
    [[nodiscard]] const std::optional<OperationForm>& before_drag() const { return before_drag_; }

    // --- smoothing by the mouse

    /// The form's model, followed live.
    [[nodiscard]] LiveSmoothing& live() { return live_; }

    [[nodiscard]] const LiveSmoothing& live() const { return live_; }

    /// What is known of the quality that the form's parameters give.
    [[nodiscard]] QualityAnalysis& quality() { return quality_; }

    [[nodiscard]] const QualityAnalysis& quality() const { return quality_; }

    /// True if movements of the mouse can drive fields of the form.
    [[nodiscard]] bool can_drive() const;

    /// As begin_drag(), and the model follows the form from now on. end_drag() keeps the values,
    /// cancel_drag() brings back those from before.
    void begin_driving();

    /// As begin_drag(), for a value that is dragged in a quality graph; the model follows if it
    /// can.
    void begin_setting();

    [[nodiscard]] bool is_driving() const { return driving_ && before_drag_; }

    /// \param reach since begin_driving()
    void drive(const DriveReach& reach);

    // --- the gallery of suggestions

    [[nodiscard]] SuggestionGallery& gallery() { return gallery_; }

    [[nodiscard]] const SuggestionGallery& gallery() const { return gallery_; }

    /// Shows it, or ends it if it is shown in this mode; ends what else the view may show instead.
    void show_gallery(GalleryMode mode);

    /// Fills in the values of a suggestion, ends the gallery, and the model follows. Ignored while
    /// it is not known.
    void take_suggestion(std::size_t i);

    // --- sliding the iso-value

    /// The surface of the image, which follows the form that extracts it.
    [[nodiscard]] LiveExtraction& extraction() { return extraction_; }

    [[nodiscard]] const LiveExtraction& extraction() const { return extraction_; }

    /// Begins or ends to show what the form says, also in the slices.
    void follow_extraction(bool on);

    /// As begin_drag(), and the surface follows the form from now on.
    void begin_sliding();

    [[nodiscard]] bool is_sliding() const { return sliding_ && before_drag_; }

    void slide(double iso);

    /// True if a model or a surface can follow the form, or graphs belong to it.
    [[nodiscard]] bool has_live_form() const {
        return live_.has_form() || extraction_.has_form() || quality_.has_form();
    }

    // --- openings

    /// All vessel ends of a form that opens them.
    [[nodiscard]] OpeningsModel& openings() { return openings_; }

    [[nodiscard]] const OpeningsModel& openings() const { return openings_; }

    /// Fills in fields of the form.
    void fill_form(const std::vector<FieldText>& texts);

    /// Chooses its end in the form's table; or adds an opening to the form's openings, or takes it
    /// away; or asks for its role, if the form is one that sets roles, or there is none.
    void click_opening(const PatchMeasures& opening);

    /// The opening whose role is asked for.
    [[nodiscard]] const std::optional<PatchMeasures>& role_question() const { return opening_; }

    /// Fills in the form so that the opening gets a role.
    void give_role(PatchKind role);

    void forget_role_question() { opening_.reset(); }

    // --- the view

    /// What the view shows besides the surface, as far as it is chosen and known.
    [[nodiscard]] const ViewData& view_data() const { return view_data_; }

    /// The file that a picture of the view was asked to be saved as; once.
    [[nodiscard]] std::filesystem::path take_picture_file() {
        return std::exchange(picture_file_, {});
    }

    [[nodiscard]] bool wants_picture() const { return !picture_file_.empty(); }

    // --- questions for a file

    [[nodiscard]] FileQuestion question() const { return question_; }

    [[nodiscard]] const std::string& asked_parameter() const { return asked_parameter_; }

    void ask(FileQuestion question, const std::string& parameter = {});
    void answer(const std::filesystem::path& file);

private:
    void renew_lists();
    void bring_back(const OperationForm& before);
    [[nodiscard]] bool update_live();
    [[nodiscard]] bool update_openings();
    [[nodiscard]] bool update_measures();
    [[nodiscard]] bool update_slices();
    void end_models_gallery();
    void end_applied_form();
    void drop_form();
    void end_spots();
    void end_measures();
    void save_recipe(const std::filesystem::path& file);
    void tell_difference();
    void tell_fallback();
    [[nodiscard]] bool update_places();
    void search_places(const Scene* scene, bool tips);
    [[nodiscard]] Arguments suggested_arguments(const Operation& operation) const;
    void arm_required();
    void show_form();
    [[nodiscard]] bool preview_is_current() const;
    [[nodiscard]] std::string why_no_worst() const;
    [[nodiscard]] bool can_change() const;

    std::vector<RailStep> rail_ = empty_rail();
    std::optional<UnitQuestion> unit_question_;
    HistoryTree history_;
    std::optional<OperationForm> form_;
    int form_number_ = 0;    ///< counts forms
    int applied_form_ = -1;  ///< the one that apply() was called for
    BrushTip tip_;           ///< of the last form of a brush
    Step step_ = Step::Source;
    int previewed_changes_ = -1;  ///< the form's, when its preview was asked for
    int seen_snapshots_ = 0, seen_entered_ = 0;
    int seen_opened_ = 0;
    FileQuestion question_ = FileQuestion::None;
    std::string asked_parameter_;
    std::string armed_, wanted_field_;
    Task<SurfacePlaces> search_;
    SurfacePlaces places_;
    ViewData view_data_;
    std::filesystem::path picture_file_;
    int searched_scenes_ = -1;  ///< the document's scene changes at the last search
    bool searched_tips_ = false;
    /// The tool and the document's scene changes that the next click measures with.
    std::pair<MeasureTool, int> measured_with_;
    ImageSlices slices_;
    std::function<void()> wake_;
    std::optional<Comparison> comparison_;
    CompareMode compare_mode_ = CompareMode::SideBySide;
    std::optional<EditId> pointed_, next_pointed_;
    std::optional<Vec3> looked_at_;
    Vec3 looked_from_ = Vec3::Zero();
    WorstTour worst_;
    int looks_ = 0;
    std::optional<OperationForm> before_drag_;
    std::optional<OperationForm> dragged_;  ///< the form before the drag that ended last
    int dragged_changes_ = -1;              ///< the form's at that end
    LiveSmoothing live_;
    QualityAnalysis quality_;
    SuggestionGallery gallery_;
    LiveExtraction extraction_;
    OpeningsModel openings_;
    AutomaticValues automatic_;
    OfferedBox offered_;
    LabelList labels_;
    bool sliding_ = false;                           ///< the drag slides the iso-value
    bool driving_ = false;                           ///< the drag drives fields by the mouse
    std::shared_ptr<const LiveModel> applied_live_;  ///< what was shown when apply() was called
    std::shared_ptr<const Positions> applied_to_;    ///< of the model at that time
    bool told_fallback_ = false;                     ///< that the device has failed
    std::optional<PatchMeasures> opening_;           ///< whose role is asked for
};

}  // namespace vesselbench
