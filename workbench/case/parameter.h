#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "workbench/case/arguments.h"

namespace vesselbench {

enum class ParameterType { Flag, Integer, Real, Text, Choice, Point, List, Records, File };

/// What a value names in the model or the image, so that a user can point at it.
enum class Meaning {
    None,
    Place,     ///< point on the surface
    Tip,       ///< point at a vessel's end or in a dome
    Branch,    ///< the same, of a branch that goes
    Inlet,     ///< point at the opening that is the inlet
    InletEnd,  ///< the same, as a number in the list of ends
    Seed,      ///< point in the image
    Box,       ///< opposite corners
    Labels,    ///< of a label image
    Name,      ///< of an opening, attribute or neighbour (geometry/kernel/plain_name.h)
    Names,     ///< several, separated by commas
    Openings,  ///< names of openings, separated by commas
    Planes,    ///< openings as planes
    Roles,     ///< of the openings of planes, with their names
    Doubts,    ///< true: the likelier choice is taken where the operation would ask
    Unit,      ///< of the model's lengths: another one moves every place
    Dabs,      ///< of a brush
    Neck       ///< direction into a sac at its neck, of an operation with its Place and Tip
};

/// An argument without which another one has no effect: "distance=margin".
struct Condition {
    std::string parameter;
    /// Any of them, in the command line's form; empty: any but the parameter's default.
    std::vector<std::string> values = {};
};

[[nodiscard]] std::string to_string(const Condition& condition);  ///< "filter=a or b", "tip"

/// How forms and pages show a parameter.
enum class Use {
    Usual,
    Rare,     ///< with others that are seldom needed, folded away unless it is given
    IfGiven,  ///< only where it is given: another name of a parameter
    /// What a run decides and its edit stores beside its arguments, for runs on other input: no
    /// field of a form and no parameter of a page. A tool, a recipe or a command may give it.
    Decision
};

/// One documented parameter: the command line's option, the check and its error text, the recipe's
/// key and the page docs/user/operations.md are all generated from this.
struct Parameter {
    std::string name;
    ParameterType type = ParameterType::Real;
    std::string unit = {};  ///< "mm", "-", "deg" ...; empty for texts
    std::optional<Value> default_value =
        {};            ///< none: the operation decides by itself, or `required`
    std::string help;  ///< one sentence; states the default decision if it is absent
    double minimum = -std::numeric_limits<double>::infinity();  ///< inclusive
    double maximum = std::numeric_limits<double>::infinity();   ///< inclusive
    std::vector<std::string> choices =
        {};  ///< of a Choice; of a Real or a Point: words in place of numbers
    bool required = false;
    bool above_minimum = false;               ///< the minimum itself is not allowed
    std::optional<Condition> only_with = {};  ///< without it, no effect; none: unconditional
    Meaning meaning = Meaning::None;
    Use use = Use::Usual;
    /// Of each of its Records, none of which has fields itself. The others take their defaults, or
    /// are required, as parameters do.
    std::vector<Parameter> fields = {};
};

/// \param parameter that the condition names
/// \param text its value in the command line's form; empty: it has none
[[nodiscard]] bool holds(const Condition& condition, const Parameter& parameter,
                         const std::string& text);

}  // namespace vesselbench
