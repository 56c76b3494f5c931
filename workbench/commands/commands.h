#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/edit_record.h"
#include "workbench/suggest/subject_options.h"

namespace vesselbench {

// One function per command of the command line; each writes its result to stdout and throws the
// classes of geometry/errors.h. The command line's parser fills in the options.

struct OperationsOptions {
    std::string name;  ///< of one operation; empty: all of them
    bool json = false;
    bool markdown = false;  ///< the page docs/user/operations.md
};

/// Prints the operation table, or one operation with its parameters.
void list_operations(const OperationsOptions& options);

/// Prints what of the system the program uses, what is missing, and how to get it.
void check_system(bool json);

struct ApplyOptions {
    std::string project;
    std::string operation;
    std::vector<std::string> arguments;  ///< "parameter=value"
    std::string variant;                 ///< empty: variant_of()
    std::string step;    ///< name of the step the edit belongs to; empty: the operation's usual one
    std::string author;  ///< empty: the login name
    std::string note;
    bool json = false;
};

/// Runs one operation and adds it to the project as an edit.
void apply_operation(const ApplyOptions& options, const Progress& progress);

struct ChangeOptions {
    std::string project;
    std::int64_t edit = 0;
    std::vector<std::string> arguments;  ///< "parameter=value"; the others stay as they were
    std::string author;                  ///< empty: the login name
    std::string note;                    ///< empty: unchanged
    bool anew = false;                   ///< later edits choose again what they chose by themselves
    bool json = false;
};

/// Runs an earlier edit with other arguments, as its next revision; later edits become pending.
void change_edit(const ChangeOptions& options, const Progress& progress);

struct RemoveOptions {
    std::string project;
    std::int64_t edit = 0;
    bool json = false;
};

/// Leaves an edit out; later edits become pending.
void remove_edit(const RemoveOptions& options);

struct NoteOptions {
    std::string project;
    std::int64_t edit = 0;
    std::string words;  ///< empty: no note
    bool json = false;
};

/// Replaces the note on an edit of the current state.
void note_edit(const NoteOptions& options);

struct LogOptions {
    std::string project;
    bool json = false;
};

/// Prints steps, edits, authors, and what each changed.
void show_log(const LogOptions& options);

struct EditsRecipeOptions {
    std::string project;
    std::string variant;    ///< empty: variant_of()
    bool portable = false;  ///< without what is of this case alone
};

/// Prints a project's edits as a recipe. Pending ones run first.
void print_edits_recipe(const EditsRecipeOptions& options, const Progress& progress);

struct RecipeOptions {
    std::string action;                ///< of recipe_actions()
    std::vector<std::string> recipes;  ///< files, bundled recipes or projects
    std::string purpose;               ///< of a project's recipes; empty: the only one
    bool json = false;
};

/// "list", "show" ...
[[nodiscard]] std::vector<std::string> recipe_actions();

/// Lists, shows, checks or compares recipes. \return the exit code
int use_recipes(const RecipeOptions& options);

/// Runs every edit again and compares. \return false if something differs
bool replay_project(const LogOptions& options, const Progress& progress);

/// Drops results that can be computed again, and prints which.
void compact(const LogOptions& options);

struct StepBackOptions {
    std::string project;
    std::optional<std::int64_t> edit;  ///< none: one state back or forward
    bool json = false;
};

void undo_edit(const StepBackOptions& options);
void redo_edit(const StepBackOptions& options);

struct MeasureOptions {
    std::string surface;              ///< or a project
    std::string variant;              ///< of a project; empty: variant_of()
    std::string reference;            ///< empty: none
    std::optional<double> histogram;  ///< bin width of the vertices' distances [mm]; none: no bins
    std::string units;                ///< of both files; empty: mm
    bool json = false;
};

/// Prints all measures of a surface, and its distance to a reference. Of a project its model, whose
/// pending edits run first, and the sac whose neck is marked.
void measure_surface(const MeasureOptions& options, const Progress& progress);

struct PictureArguments {
    std::string surface;        ///< or a project
    std::string variant;        ///< of a project; empty: variant_of()
    std::string out;            ///< .png
    bool any_name = false;      ///< for `out`
    std::string reference;      ///< empty: colours by patch
    std::string colour;         ///< vertex attribute to show; empty: none
    std::vector<double> range;  ///< its first and last colour, 2 numbers; empty: automatic
    std::vector<double> view = {0, 1, 0};  ///< view direction, 3 numbers (LPS)
    std::optional<double> full_colour;     ///< [mm]; none: 98 % of the vertices are below
    int size = 700;                        ///< width and height [pixels]
    bool transparent = false;              ///< background; else white
    std::string units;                     ///< of the files; empty: mm
    bool json = false;
};

/// Draws a surface, or a project's as far as its edits have run, coloured by patch or by its
/// deviation from a reference.
void draw_picture(const PictureArguments& arguments);

struct SuggestOptions {
    SubjectOptions subject;
    double tau = 0.5;   ///< target smoothness
    std::string score;  ///< empty: the operation's usual one
    std::string search = "automatic";
    std::string truth;  ///< surface file, in the subject's units; empty: none
    bool grid = false;  ///< adds all coarse sets to the JSON document
    bool json = false;
};

/// Suggests parameters of an operation for a surface.
void suggest_parameters(const SuggestOptions& options, const Progress& progress);

/// Without a variant, a project's is the purpose prepared last, as of `apply` and `export`.
[[nodiscard]] SubjectOptions with_prepared_variant(SubjectOptions options);

struct QualityOptions {
    SubjectOptions subject;
    std::vector<std::string> out;  ///< .svg (graphs, or bars if its name contains that) and .png
    double tau = 0.5;
    std::string sort = "parameter";  ///< of bars: parameter or measure
    std::vector<double> at;          ///< artifact of the gallery, 3 numbers [mm]; empty: automatic
    bool json = false;
};

/// Draws how the parameters of an operation change a surface's quality.
void draw_quality(const QualityOptions& options, const Progress& progress);

struct CenterlineOptions {
    std::string surface;
    std::string out;    ///< VTP file
    std::string units;  ///< of the surface file; empty: mm
    bool json = false;
};

/// Finds the vessel tree's centerlines and writes them.
void find_centerlines(const CenterlineOptions& options, const Progress& progress);

struct PhantomOptions {
    std::optional<std::uint64_t> seed;  ///< none: the description's own
    std::string name;
    std::string out;
    bool json = false;
};

/// Writes a phantom's image, mask and exact surface, and a case.json beside them.
void write_phantom(const PhantomOptions& options, const Progress& progress);

struct InputArguments {
    std::string input;
    std::string mask;
    std::string units;
    std::vector<std::string> neighbours;  ///< files, labels "7,8", or names of segments
    std::string label;                    ///< segments that are the vessel; empty: not chosen
    std::string mask_is;                  ///< "wall" or "region"; empty: by the mask
};

/// What the caller says about vessel ends: each text is numbers of `ends`, "1" or "4,7", or a place
/// "x,y,z" [mm].
struct EndArguments {
    std::vector<std::string> inlets, open, close;
    std::string vessel;  ///< "artery", "vein" or "portal"; empty: not said
    bool accept_doubts = false;
};

struct PrepareArguments {
    InputArguments input;
    std::string purpose;
    std::string recipe;
    std::vector<std::string> settings;  ///< "operation.parameter=value"
    EndArguments ends;
    std::vector<std::string> refinements;  ///< "x,y,z:radius:edge"
    std::string out;
    std::string author;  ///< empty: the login name
    std::string name;    ///< of the input in the report; empty: the file's
    bool resume = false;
    bool question = false;  ///< a doubt about vessel ends leaves what a batch asks with
    bool run = false;       ///< solves the flow, and reads its results
    bool json = false;
};

/// Settings with those that name vessel ends.
/// \throw UsageError if a text names no end
[[nodiscard]] std::vector<std::string> with_ends(std::vector<std::string> settings,
                                                 const EndArguments& ends);

/// Turns the input into a CFD or print model.
/// \param refused gets the diagnostics of a preparation that stops, as JSON with commands
/// \return the exit code: 1 if the flow was to be solved, and has not converged
int prepare_case(const PrepareArguments& arguments, const Progress& progress,
                 const std::function<void(std::string)>& refused);

struct EndsOptions {
    InputArguments input;               ///< a project as well
    std::vector<std::string> settings;  ///< "operation.parameter=value"
    EndArguments ends;
    std::string picture;  ///< PNG file; empty: none
    bool json = false;
};

/// Lists the vessel ends and what would become of them, without making a model.
void list_ends(const EndsOptions& options, const Progress& progress);

struct NewArguments {
    std::string project;
    InputArguments input;
    std::string author;  ///< empty: the login name
    std::string name;    ///< of the input in reports; empty: the file's
    bool json = false;
};

/// Creates a project with the input.
void make_project(const NewArguments& arguments, const Progress& progress);

struct ExportArguments {
    std::string project;
    std::string file;
    std::string variant;                ///< empty: variant_of()
    std::vector<std::string> settings;  ///< "openfoam.parameter=value"
    std::string required;               ///< "accepted", "accepted=2"; empty: nothing
    std::string signers;         ///< allowed ones, who sign acceptances; empty: none need be signed
    std::string colour;          ///< measure shown on the model; empty: none
    std::string images = "off";  ///< of a page: off or slices
    std::string title;           ///< of a page; empty: the project's name
    std::string text;            ///< of a page, about the case
    bool json = false;
};

/// Writes the project's model as a file, or as an OpenFOAM case.
void export_project(const ExportArguments& arguments, const Progress& progress);

struct AuditArguments {
    std::string project;
    std::string html;                  ///< file to write; empty: none
    std::vector<std::string> against;  ///< witnesses_in()
    std::string signers;               ///< file of allowed signers; empty: nothing is verified
    bool replay = false;
    bool witness = false;  ///< prints one line for a lab book in place of the record
    bool json = false;
};

/// Prints a project's record and verifies the project against it. \return false if it contradicts
bool audit_project(const AuditArguments& arguments, const Progress& progress);

struct ReviewArguments {
    std::vector<std::string> projects;  ///< one, or with `summary` any number
    std::vector<std::string> imported;  ///< files of verdicts
    std::string signers;                ///< file of allowed signers; empty: nothing is verified
    std::string retired_key;            ///< fingerprint of a key that is to be retired; empty: none
    std::string reason;                 ///< why it is retired
    std::string page;                   ///< to be written for reviewers; empty: none
    std::string images = "contours";    ///< of the page: off, contours or slices
    std::string variant;                ///< of the page; empty: the only one, or the usual one
    bool summary = false;               ///< how far the reviewers of all projects agree
    bool json = false;
};

/// Prints by operation how far reviewers agree, over several projects.
/// \return false if one could not be read: the others are counted
bool summarize_reviews(const ReviewArguments& arguments, const Progress& progress);

/// Enters reviewers' verdicts, retires a key, lists how every edit was judged, and writes the page
/// on which reviewers look at them.
void review_project(const ReviewArguments& arguments, const Progress& progress);

struct FindingsArguments {
    std::string project;
    std::string variant;    ///< empty: variant_of()
    std::string applied;    ///< id of the finding whose operation runs; empty: none
    std::string taken_as;   ///< reading that it is applied for; empty: it is no question
    std::string kept;       ///< id of one that is answered with "keep"; empty: none
    std::string dismissed;  ///< the same, with a reason; empty: none
    std::string reason;     ///< why it is kept
    std::string restored;   ///< id of the finding whose dismissal is taken back; empty: none
    bool all = false;       ///< lists the less certain ones as well
    bool tried = false;     ///< says which operations would be refused
    bool json = false;
};

/// Lists what looks like an artefact on a project's model, or treats, keeps or restores one.
void show_findings(const FindingsArguments& arguments, const Progress& progress);

struct WindowOptions {
    std::string file;        ///< to open at once; empty: the start screen
    std::string screenshot;  ///< PNG file
    std::string size = "1280x720";
    std::string theme = "dark";
};

struct DocsOptions {
    std::vector<std::string> words;  ///< searched for; empty: the start page
    bool json = false;
};

/// Shows the handbook in the browser, or what a search in it finds, and prints the address.
/// \throw AlgorithmFailure if it is not there
void show_docs(const DocsOptions& options);

/// Opens the window, and returns when it is closed or a stop is requested.
void open_window(const WindowOptions& options, const std::stop_token& stop);

/// Draws the window once, without a display, when the file is open.
void draw_screenshot(const WindowOptions& options);

}  // namespace vesselbench
