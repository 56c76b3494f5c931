#include "workbench/commands/shell/manual_page.h"

#include <sstream>

#include "workbench/case/version.h"

namespace vesselbench {

namespace {

/// A line of text: nothing in it is a request or an escape.
std::string safe_line(const std::string& line) {
    std::string safe = line.starts_with('.') || line.starts_with('\'') ? "\\&" : "";
    for (const char letter : line) {
        if (letter == '\\')
            safe += "\\e";
        else if (letter == '-')
            safe += "\\-";
        else
            safe += letter;
    }
    return safe;
}

/// Lines that are filled; an empty one ends a paragraph.
std::string paragraphs(const std::string& text) {
    std::string lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines += line.empty() ? ".PP\n" : safe_line(line) + "\n";
    return lines;
}

/// Lines as they are: lists and examples.
std::string verbatim(const std::string& text) {
    if (text.empty()) return "";
    std::string lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines += safe_line(line) + "\n";
    return ".PP\n.nf\n" + lines + ".fi\n";
}

std::string tagged(const std::string& tag, const std::string& text) {
    return ".TP\n\\fB" + safe_line(tag) + "\\fR\n" + paragraphs(text);
}

std::string command_section(const CommandRow& command) {
    std::string usage = command.name;
    for (const std::string& positional : command.positionals) usage += " " + positional;
    std::string text = ".SS \"" + safe_line(usage) + "\"\n" + paragraphs(command.summary);
    for (const OptionRow& option : command.options) {
        if (option.name == "--help") continue;  // said once, of all
        const std::string names =
            option.letter.empty() ? option.name : option.letter + ", " + option.name;
        text += tagged(names + (option.value.empty() ? "" : " " + option.value), option.help);
    }
    return text + verbatim(command.footer);
}

/// What the program writes beside what it is asked for (docs/user/privacy.md).
std::string files_section() {
    return ".SH FILES\n" +
           tagged("$XDG_CONFIG_HOME/vesselbench",
                  "The window's settings; without the variable, in ~/.config.") +
           tagged("$XDG_STATE_HOME/vesselbench",
                  "Reports of crashes, which are sent nowhere; without the variable, in "
                  "~/.local/state.") +
           tagged("$XDG_CACHE_HOME/vesselbench",
                  "What can be made again; without the variable, in ~/.cache.") +
           tagged("/usr/share/doc/vesselbench/html/index.html", "The handbook, of a package.") +
           tagged("/usr/share/vesselbench/cases", "Bundled cases, of a package.") +
           tagged("/usr/share/vesselbench/recipe.schema.json",
                  "The JSON Schema of recipes, for editors.");
}

}  // namespace

std::string manual_page(std::span<const CommandRow> commands,
                        std::span<const Operation> operations) {
    std::string text = ".TH VESSELBENCH 1 \"\" \"vesselbench " + safe_line(version()) +
                       "\" \"User Commands\"\n"
                       ".SH NAME\nvesselbench \\- vessel images and raw vessel surfaces to CFD "
                       "models and print models\n"
                       ".SH SYNOPSIS\n.B vesselbench\n[\\fICOMMAND\\fR [\\fIARGUMENTS\\fR]]\n"
                       ".SH DESCRIPTION\n"
                       "Without a command, the window opens. The commands below do the same work "
                       "without it. "
                       "\\fB\\-\\-help\\fR after a command explains it.\n"
                       ".SH COMMANDS\n";
    for (const CommandRow& command : commands) text += command_section(command);
    text +=
        ".SH OPERATIONS\n"
        "What \\fBapply\\fR runs; \\fBvesselbench operations\\fR \\fINAME\\fR lists the "
        "parameters.\n";
    for (const Operation& operation : operations) text += tagged(operation.name, operation.summary);
    return text +
           ".SH EXIT STATUS\n"
           ".TP\n0\nDone.\n.TP\n1\nThe operation could not be done.\n.TP\n2\nWrong usage.\n"
           ".TP\n3\nThe input is bad.\n" +
           files_section() +
           ".SH SEE ALSO\n"
           "\\fBvesselbench docs\\fR shows the handbook, which explains every figure.\n"
           ".PP\n.BR gmsh (1),\n.BR ssh\\-keygen (1)\n";
}

}  // namespace vesselbench
