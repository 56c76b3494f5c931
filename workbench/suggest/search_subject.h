#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/quality/search.h"
#include "workbench/case/operation.h"
#include "workbench/operations/smoothing_subject.h"
#include "workbench/suggest/subject_options.h"

namespace vesselbench {

/// The surface and the arguments that the operation would get.
struct SearchSubject {
    std::string name;  ///< of the source, without its folder
    bool is_project = false;
    std::string state;    ///< of a project: the edit it follows; else empty
    std::string variant;  ///< of a project, if the operation belongs to one; else empty
    const Operation* operation = nullptr;
    Scene scene;
    Arguments given;                            ///< as given by the user
    Arguments arguments;                        ///< with defaults; resolved if a filter is searched
    std::optional<SmoothingSubject> smoothing;  ///< of operations that search a filter
    std::vector<std::string> notes;             ///< remarks for the user
};

/// A project's surface is the one after its last edit of the steps up to the operation's usual one:
/// the one that `apply PROJECT OPERATION --variant V` would change.
/// \throw UsageError if the operation cannot be searched; UsageError, InvalidInput,
/// AlgorithmFailure as the operation and the readers
[[nodiscard]] SearchSubject search_subject(const SubjectOptions& options, const Progress& progress);

/// "filter laplace", "remesh": the change of the surface, for a title.
[[nodiscard]] std::string change_text(const SearchSubject& subject);

/// The default score for suggestions of an operation: compact for those meant to change the number
/// of triangles.
[[nodiscard]] ScoreForm usual_score(const SearchSubject& subject);

/// The search space; a given parameter keeps its value.
/// \param chosen as from engine_for
/// \param all_parameters for graphs, which start from the given values
[[nodiscard]] SearchSpace space_for(const SearchSubject& subject, const ChosenEngine& chosen,
                                    bool all_parameters = false);

/// The engine of a filter; none for other operations, which run on the CPU.
[[nodiscard]] ChosenEngine engine_for(const SearchSubject& subject, bool planes = false);

/// \param chosen as from engine_for; a GPU's is used on this thread only
[[nodiscard]] ParameterSearch search_for(const SearchSubject& subject, const ChosenEngine& chosen,
                                         const SearchSpace& space, ScoreSettings settings);

/// The given arguments as a set of that space.
[[nodiscard]] ParameterSet given_set(const SearchSubject& subject, const SearchSpace& space,
                                     const Progress& progress = {});

/// The arguments that make the operation use a set: those given, and the set's.
[[nodiscard]] Arguments arguments_of(const SearchSubject& subject, const SearchSpace& space,
                                     const ParameterSet& set);

/// The same without the values the operation decides by itself: the arguments to type.
[[nodiscard]] Arguments typed_arguments(const SearchSubject& subject, const SearchSpace& space,
                                        const ParameterSet& set);

/// The operation's result with a set; of a filter, without the check for crossing walls.
[[nodiscard]] Surface changed_with(const SearchSubject& subject, const SearchSpace& space,
                                   const ParameterSet& set, const Progress& progress = {});

}  // namespace vesselbench
