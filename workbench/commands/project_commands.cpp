#include "workbench/commands/project_commands.h"

#include <memory>
#include <string>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/colours/shown_measure.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/flow_parameters.h"

namespace vesselbench {

namespace {

/// "OpenFOAM takes --set openfoam.flow, split, ...", in lines of a terminal's width.
std::string flow_parameters_text() {
    constexpr std::size_t kWidth = 88;
    std::string text, line = "OpenFOAM takes --set openfoam.";
    for (const Parameter& parameter : flow_parameters()) {
        if (line.size() + parameter.name.size() > kWidth) {
            line.back() = '\n';
            text += std::exchange(line, "");
        }
        line += parameter.name + ", ";
    }
    text += line;
    text.replace(text.size() - 2, 2, "; --set may be repeated.");
    return text;
}

std::string export_footer() {
    return "Formats by suffix, with the unit of length:\n" + export_formats_text() +
           flow_parameters_text();
}

constexpr const char* kChangeFooter =
    "Later edits become pending: they run again when their result is shown, exported or built\n"
    "upon. 'undo' reverts the change.";

void add_apply(CommandLine& line) {
    const auto options = std::make_shared<ApplyOptions>();
    CLI::App& command =
        add_command(line, "apply", "Run an operation on a project, as an edit that can be undone",
                    [options, &line] { return apply_operation(*options, line.progress), 0; });
    add_project(command, options->project);
    command.add_option("OPERATION", options->operation, "Its name, as listed by 'operations'")
        ->required()
        ->type_name("");
    command
        .add_option("parameter=value", options->arguments,
                    "Its arguments; see 'vesselbench operations OPERATION'")
        ->type_name("");
    add_variant(command, options->variant, "Variant for edits of steps 4-8: cfd, rp or a name");
    command
        .add_option("--step", options->step,
                    "Step the edit belongs to (default: the operation's usual step)")
        ->type_name("STEP");
    command.add_option("--author", options->author, "Author of the edit (default: login name)")
        ->type_name("NAME");
    command.add_option("--note", options->note, "Reason, in your own words")->type_name("WORDS");
    add_json(command, options->json, "Print the edit as one JSON document");
}

void add_edit(CLI::App& command, std::int64_t& edit) {
    command.add_option("EDIT", edit, "Its number, as 'log' lists it")->required()->type_name("");
}

void add_change_and_remove(CommandLine& line) {
    const auto changed = std::make_shared<ChangeOptions>();
    CLI::App& change =
        add_command(line, "change", "Run an earlier edit with other arguments",
                    [changed, &line] { return change_edit(*changed, line.progress), 0; });
    add_project(change, changed->project);
    add_edit(change, changed->edit);
    change
        .add_option("parameter=value", changed->arguments,
                    "Arguments to replace; the others stay as they were given")
        ->type_name("");
    change.add_option("--author", changed->author, "Who makes the change (default: login name)")
        ->type_name("NAME");
    change.add_option("--note", changed->note, "Reason, in your own words (default: as it was)")
        ->type_name("WORDS");
    change.add_flag("--anew", changed->anew,
                    "Later edits choose again what they chose automatically: openings, planes,\n"
                    "sizes (changing the model's unit always does this)");
    add_json(change, changed->json, "Print the edit as one JSON document");
    change.footer(kChangeFooter);
    const auto removed = std::make_shared<RemoveOptions>();
    CLI::App& remove = add_command(line, "remove", "Leave an edit out",
                                   [removed] { return remove_edit(*removed), 0; });
    add_project(remove, removed->project);
    add_edit(remove, removed->edit);
    add_json(remove, removed->json);
    remove.footer(kChangeFooter);
}

void add_note(CommandLine& line) {
    const auto options = std::make_shared<NoteOptions>();
    CLI::App& command = add_command(line, "note", "Write a note on an edit, or remove it",
                                    [options] { return note_edit(*options), 0; });
    add_project(command, options->project);
    add_edit(command, options->edit);
    command.add_option("WORDS", options->words, "The note (default: none)")->type_name("");
    add_json(command, options->json);
}

void add_log(CommandLine& line) {
    const auto options = std::make_shared<LogOptions>();
    const auto recipe = std::make_shared<EditsRecipeOptions>();
    const auto as_recipe = std::make_shared<bool>(false);
    CLI::App& command =
        add_command(line, "log", "List steps, edits, authors, and what each edit changed",
                    [options, recipe, as_recipe, &line] {
                        recipe->project = options->project;
                        if (*as_recipe)
                            print_edits_recipe(*recipe, line.progress);
                        else
                            show_log(*options);
                        return 0;
                    });
    add_project(command, options->project);
    CLI::Option* asked = command.add_flag(
        "--recipe", *as_recipe,
        "Print the edits of a variant as a recipe, with which prepare makes the same model of the\n"
        "same input; comments name what is of this case alone");
    command
        .add_flag("--portable", recipe->portable,
                  "For other cases: leave out edits of places and files of this one")
        ->needs(asked);
    add_variant(command, recipe->variant, "Variant of the recipe: cfd, rp or a name");
    command.get_option("--variant")->needs(asked);
    add_json(command, options->json);
    asked->excludes(command.get_option("--json"));
}

void add_undo_and_redo(CommandLine& line) {
    const auto options = std::make_shared<StepBackOptions>();
    CLI::App& undo = add_command(line, "undo", "Return to the state before an edit",
                                 [options] { return undo_edit(*options), 0; });
    add_project(undo, options->project);
    undo.add_option("EDIT", options->edit, "Return to before this edit (default: the last one)")
        ->type_name("");
    add_json(undo, options->json);
    CLI::App& redo = add_command(line, "redo", "Redo an edit that was undone",
                                 [options] { return redo_edit(*options), 0; });
    add_project(redo, options->project);
    redo.add_option("EDIT", options->edit, "Redo up to this edit (default: one state)")
        ->type_name("");
    add_json(redo, options->json);
}

void add_replay(CommandLine& line) {
    const auto options = std::make_shared<LogOptions>();
    CLI::App& command = add_command(
        line, "replay", "Run every edit again and compare with the stored results, bit for bit",
        [options, &line] { return replay_project(*options, line.progress) ? 0 : 1; });
    add_project(command, options->project);
    add_json(command, options->json);
}

CLI::Option* add_signers(CLI::App& command, std::string& signers, const std::string& help) {
    return command
        .add_option("--signers", signers,
                    help + "\n(the file: ALLOWED SIGNERS in ssh-keygen's manual)")
        ->type_name("ALLOWED_SIGNERS");
}

void add_audit(CommandLine& line) {
    const auto options = std::make_shared<AuditArguments>();
    CLI::App& command = add_command(
        line, "audit", "Print the record of a project, and verify the project against it",
        [options, &line] { return audit_project(*options, line.progress) ? 0 : 1; });
    add_project(command, options->project);
    command
        .add_option(
            "--against", options->against,
            "What saw the record earlier, and must still be in it: verdicts of reviewers, an\n"
            "older copy of the project, or a line of --witness (itself, or in a text file)")
        ->type_name("WITNESS");
    add_signers(command, options->signers, "Verify the signatures of verdicts by ssh-keygen");
    command.add_flag("--replay", options->replay,
                     "Run the edits of the current state again as well");
    command.add_option("--html", options->html, "Write the record as a page")->type_name("FILE");
    CLI::Option* witness = command.add_flag(
        "--witness", options->witness,
        "Print only a line for a lab book, by which --against finds an end that was cut off");
    add_json(command, options->json);
    witness->excludes(command.get_option("--json"));
}

void add_summary(CLI::App& command, ReviewArguments& options) {
    CLI::Option* summary = command.add_flag(
        "--summary", options.summary,
        "How far the reviewers of one or several projects agree, by operation: number of edits\n"
        "that two or more have decided, of their verdicts, share of agreement, and from 30 edits\n"
        "on Krippendorff's alpha with its 95 % interval. 'unsure' is no decision");
    for (const char* other :
         {"--import", "--signers", "--retire-key", "--out", "--images", "--variant"})
        summary->excludes(command.get_option(other));
}

/// \return the exit code
int run_review(const ReviewArguments& options, const Progress& progress) {
    if (options.summary) return summarize_reviews(options, progress) ? 0 : 3;
    return review_project(options, progress), 0;
}

void add_review(CommandLine& line) {
    const auto options = std::make_shared<ReviewArguments>();
    CLI::App& command =
        add_command(line, "review",
                    "Write the page on which experts review the edits; enter their verdicts; list "
                    "how every edit was judged, or how far reviewers agree",
                    [options, &line] { return run_review(*options, line.progress); });
    command
        .add_option("PROJECT", options->projects,
                    "Project file (.vbench); with --summary one or several")
        ->required()
        ->type_name("");
    command
        .add_option("--import", options->imported,
                    "Enter the verdicts that a reviewer has saved, once each")
        ->type_name("VERDICTS.json");
    add_signers(command, options->signers,
                "Verify signatures by ssh-keygen, and refuse to enter verdicts without one");
    CLI::Option* retired =
        command
            .add_option("--retire-key", options->retired_key,
                        "Enter that nobody signs with this key any more, by its fingerprint: what\n"
                        "it signs from now on is refused")
            ->type_name("SHA256:...");
    CLI::Option* reason = command.add_option("--reason", options->reason, "Why the key is retired")
                              ->type_name("WORDS")
                              ->needs(retired);
    retired->needs(reason);
    command
        .add_option("--out", options->page,
                    "Write one self-contained page with the variant's edits, for any browser")
        ->type_name("PAGE.html");
    command
        .add_option("--images", options->images,
                    "What the page shows through each edit's place: off; contours of the surfaces; "
                    "slices of the image as well")
        ->check(CLI::IsMember({"off", "contours", "slices"}));
    add_variant(command, options->variant, "Variant of the page: cfd, rp or a name");
    add_summary(command, *options);
    add_json(command, options->json);
}

void add_findings(CommandLine& line) {
    const auto options = std::make_shared<FindingsArguments>();
    CLI::App& command =
        add_command(line, "findings",
                    "List what looks like an artefact on the model, with its evidence and the "
                    "operation that would treat it",
                    [options, &line] { return show_findings(*options, line.progress), 0; });
    add_project(command, options->project);
    add_variant(command, options->variant, "Variant whose model is looked at: cfd, rp or a name");
    const auto add = [&](const char* name, std::string& value, const char* help) {
        return command.add_option(name, value, help)->type_name("FINDING");
    };
    const std::vector<CLI::Option*> acts = {
        add("--keep", options->kept,
            "Leave what was found as it is: it is no longer listed. Without --reason, what a\n"
            "question asked becomes the reason"),
        add("--apply", options->applied,
            "Run the operation that treats a finding, as an edit; one that may be anatomy\n"
            "needs --as"),
        add("--dismiss", options->dismissed, "As --keep, with a --reason"),
        add("--restore", options->restored, "Take back that a finding was kept"),
        add("--accept", options->applied, "As --apply")->group("")};
    for (CLI::Option* act : acts)
        for (CLI::Option* other : acts)
            if (act != other) act->excludes(other);
    command
        .add_option("--as", options->taken_as,
                    "What a finding that may be anatomy is, by the words of the list: stub,\n"
                    "artefact, contact or debris")
        ->type_name("READING");
    command
        .add_option("--reason", options->reason,
                    "Why it is kept, in your own words; it stays in the project's record")
        ->type_name("WORDS");
    command.add_flag("--all", options->all,
                     "List also what is less than 50 % certain; --json always does");
    command.add_flag(
        "--try", options->tried,
        "Try the operation of each that is listed, and say which are refused, and why");
    add_json(command, options->json);
}

void add_compact(CommandLine& line) {
    const auto options = std::make_shared<LogOptions>();
    CLI::App& command =
        add_command(line, "compact",
                    "Make a project smaller: drop results of undone edits, which can be computed "
                    "again; no edit is lost",
                    [options] {
                        compact(*options);
                        return 0;
                    });
    add_project(command, options->project);
    add_json(command, options->json);
}

/// Of models for viewers.
void add_shown(CLI::App& command, ExportArguments& options) {
    command
        .add_option("--colour", options.colour,
                    "Measure on the wall of a .glb or .html: " + measure_names_text() +
                        ";\nor a vertex attribute, as smooth keep_weights=true adds it")
        ->type_name("NAME");
    command
        .add_option("--images", options.images,
                    "What a .html holds of the image: off; three slices through the model")
        ->check(CLI::IsMember({"off", "slices"}));
    command.add_option("--title", options.title, "Title of a .html (default: the project's name)")
        ->type_name("WORDS");
    command.add_option("--text", options.text, "Text of a .html about the case")
        ->type_name("WORDS");
}

void add_export(CommandLine& line) {
    const auto options = std::make_shared<ExportArguments>();
    CLI::App& command =
        add_command(line, "export", "Export the model to a file, or as an OpenFOAM case",
                    [options, &line] { return export_project(*options, line.progress), 0; });
    add_project(command, options->project);
    command
        .add_option("FILE", options->file,
                    "Its suffix determines the format; a folder: an OpenFOAM case")
        ->required()
        ->type_name("");
    command.footer(export_footer());
    add_variant(command, options->variant, "Variant to write");
    add_settings(command, options->settings,
                 "openfoam.parameter=value: change the flow of the case", kFlowSettingValue);
    command
        .add_option("--require", options->required,
                    "accepted, accepted=2: refuse unless so many reviewers have accepted every\n"
                    "edit of the model")
        ->type_name("REVIEW");
    add_signers(command, options->signers,
                "Of acceptances, count those only that an allowed signer has signed")
        ->needs(command.get_option("--require"));
    add_shown(command, *options);
    add_json(command, options->json);
}

}  // namespace

void add_project_commands(CommandLine& line) {
    add_apply(line);
    add_change_and_remove(line);
    add_note(line);
    add_log(line);
    add_undo_and_redo(line);
    add_replay(line);
    add_audit(line);
    add_review(line);
    add_findings(line);
    add_compact(line);
    add_export(line);
}

}  // namespace vesselbench
