#pragma once

#include <optional>
#include <set>
#include <string>

#include "workbench/case/edit_record.h"
#include "workbench/window/core/panel_sizes.h"
#include "workbench/window/drawing/picture_look.h"
#include "workbench/window/keys/key_table.h"

namespace vesselbench {

enum class BottomTab { History, Messages, Measures, Findings };

enum class FormTab { Fields, Live };

/// How the quality of parameters is drawn.
enum class QualityView { Graphs, BarsByParameter, BarsByMeasure };

/// A note while it is written.
struct NoteInProgress {
    EditRef edit;
    std::string title;  ///< of the edit: "Clip opening"
    std::string words;
};

/// What the user asks to leave while an edit runs.
enum class Leaving { Nothing, Case, Window };

/// Which parts of the window are shown.
struct Shown {
    BottomTab bottom = BottomTab::History;
    FormTab form = FormTab::Fields;  ///< of forms that can be followed live
    QualityView quality = QualityView::Graphs;
    std::string unfolded_form;  ///< whose seldom needed fields are seen: prefix and operation
    Enlarged enlarged = Enlarged::None;
    bool help = false;
    bool prepare = false;                   ///< the question for what to prepare
    std::string purpose = kDefaultVariant;  ///< answer so far
    std::optional<Step> again_from;         ///< of its own steps, to be made again; none: missing
    std::optional<std::size_t> entry;       ///< of the recipe, whose values are seen
    std::optional<NoteInProgress> note;     ///< the dialog for it
    Leaving leaving = Leaving::Nothing;     ///< asked, and not answered
    bool closes = false;                    ///< the window may be closed, whatever runs
    std::set<EditId> unfolded;              ///< first edits of strokes that the rail lists singly
    std::set<StateId> unfolded_states;      ///< the same of the history
    bool view = false;                      ///< the view's options
    PictureLook picture;                    ///< of those that are saved
    float banners_end = 0;                  ///< lower end of those in the view [pixels]; 0: none
    bool compact = false;                   ///< little room: tool buttons without labels
    KeyCommands keys;                       ///< of this frame
};

/// Enlarges a part, or gives it back its room.
inline void switch_enlarged(Shown& shown, Enlarged part) {
    shown.enlarged = shown.enlarged == part ? Enlarged::None : part;
}

}  // namespace vesselbench
