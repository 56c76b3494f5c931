#pragma once

#include <memory>
#include <string>
#include <vector>

#include "quality/smoothing_space.h"

#include "gpu/gpu_engine.h"
#include "workbench/arguments.h"
#include "workbench/scene.h"

namespace vesselbench {

/// What the command line says about a search of smoothing parameters.
struct SubjectOptions {
    std::string source;                  ///< a project or a surface file
    std::string units;                   ///< of a surface file; empty: mm
    std::string filter;                  ///< empty: as `smooth` decides
    std::vector<std::string> arguments;  ///< "parameter=value" of `smooth`, which stay
};

/// A surface as `smooth` would find it, and what `smooth` would be told.
struct SearchSubject {
    std::string name;  ///< of the source, without its folder
    bool is_project = false;
    std::string state;  ///< of a project: which edit it is after; else empty
    Scene scene;
    Arguments given;      ///< of `smooth`, as the user gave them
    Arguments arguments;  ///< of `smooth`, resolved
    FilterParameters filter;
    FilterGround ground;
    std::shared_ptr<const std::vector<double>> weights;  ///< at the given arguments; null: all 1
    StaircaseWeights staircase;                          ///< null without staircase=true
    double slice = 1.0;                                  ///< distance of the image's slices [mm]
    std::vector<std::string> notes;                      ///< what a user should know
};

/// A project's surface is the one after its last edit of the steps up to smoothing: the one that
/// `apply PROJECT smooth` would smooth.
/// \throw UsageError, InvalidInput, AlgorithmFailure as `smooth` and the readers
[[nodiscard]] SearchSubject search_subject(const SubjectOptions& options, const Progress& progress);

/// What measures parameter sets, on the device that the argument `device` of `smooth` names: auto
/// takes a GPU where there is one. Used on this thread only, if it is a GPU's. \param planes
/// measures the error as Eq. 6.2 prints it, too
[[nodiscard]] ChosenEngine engine_for(const SearchSubject& subject, bool planes = false);

/// \param all_parameters for graphs
[[nodiscard]] SearchSpace space_for(const SearchSubject& subject, bool all_parameters = false);

/// The given arguments as a set of that space.
[[nodiscard]] ParameterSet given_set(const SearchSubject& subject, const SearchSpace& space);

/// The arguments with which `smooth` does what a set means: those given, and the set's.
[[nodiscard]] Arguments arguments_of(const SearchSubject& subject, const SearchSpace& space,
                                     const ParameterSet& set);

/// The same without what `smooth` decides by itself: what a user types.
[[nodiscard]] Arguments typed_arguments(const SearchSubject& subject, const SearchSpace& space,
                                        const ParameterSet& set);

/// The surface smoothed with a set, as `smooth` does it but for walls that would cross.
[[nodiscard]] Surface smoothed_with(const SearchSubject& subject, const SearchSpace& space,
                                    const ParameterSet& set, const Progress& progress = {});

}  // namespace vesselbench
