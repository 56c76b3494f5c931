#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/search.h"
#include "workbench/case/operation.h"
#include "workbench/suggest/smoothing_subject.h"
#include "workbench/suggest/subject_options.h"

namespace vesselbench {

/// A surface as the operation would find it, and what the operation would be told.
struct SearchSubject {
    std::string name;  ///< of the source, without its folder
    bool is_project = false;
    std::string state;    ///< of a project: which edit it is after; else empty
    std::string variant;  ///< of a project, where the operation belongs to one; else empty
    const Operation* operation = nullptr;
    Scene scene;
    Arguments given;                            ///< as the user gave them
    Arguments arguments;                        ///< with defaults; of `smooth` resolved
    std::optional<SmoothingSubject> smoothing;  ///< of `smooth` only
    std::vector<std::string> notes;             ///< what a user should know
};

/// A project's surface is the one after its last edit of the steps up to the operation's usual one:
/// the one that `apply PROJECT OPERATION --variant V` would change.
/// \throw UsageError if the operation is none that can be searched; UsageError, InvalidInput,
/// AlgorithmFailure as `smooth` and the readers
[[nodiscard]] SearchSubject search_subject(const SubjectOptions& options, const Progress& progress);

/// "filter laplace", "remesh": what changes the surface, in a title.
[[nodiscard]] std::string change_text(const SearchSubject& subject);

/// The score that suggestions of an operation go by when the user names none: compact for those
/// that are there to change the number of triangles.
[[nodiscard]] ScoreForm usual_score(const SearchSubject& subject);

/// \param chosen as engine_for gave it
/// What a search goes through; a parameter that was given keeps its value.
/// \param all_parameters for graphs, which start from the values that were given
[[nodiscard]] SearchSpace space_for(const SearchSubject& subject, const ChosenEngine& chosen,
                                    bool all_parameters = false);

/// The engine of `smooth`; none of other operations, which the CPU runs.
[[nodiscard]] ChosenEngine engine_for(const SearchSubject& subject, bool planes = false);

/// \param chosen as engine_for gave it; used on this thread only, if it is a GPU's
[[nodiscard]] ParameterSearch search_for(const SearchSubject& subject, const ChosenEngine& chosen,
                                         const SearchSpace& space, ScoreSettings settings);

/// The given arguments as a set of that space.
[[nodiscard]] ParameterSet given_set(const SearchSubject& subject, const SearchSpace& space,
                                     const Progress& progress = {});

/// The arguments with which the operation does what a set means: those given, and the set's.
[[nodiscard]] Arguments arguments_of(const SearchSubject& subject, const SearchSpace& space,
                                     const ParameterSet& set);

/// The same without what the operation decides by itself: what a user types.
[[nodiscard]] Arguments typed_arguments(const SearchSubject& subject, const SearchSpace& space,
                                        const ParameterSet& set);

/// What the operation makes of the surface with a set; `smooth` but for walls that would cross.
[[nodiscard]] Surface changed_with(const SearchSubject& subject, const SearchSpace& space,
                                   const ParameterSet& set, const Progress& progress = {});

}  // namespace vesselbench
