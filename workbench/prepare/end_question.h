#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/vec3.h"
#include "workbench/prepare/end_role.h"
#include "workbench/prepare/prepare_options.h"
#include "workbench/prepare/recipe.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// The code of a preparation that stopped because vessel ends or the inlet are in doubt.
inline constexpr const char* kEndInDoubt = "end-in-doubt";

/// What such a preparation leaves in its folder if it was asked to: the ends in JSON, and their
/// picture, which is missing without usable OpenGL.
inline constexpr const char* kEndQuestion = "question.json";
inline constexpr const char* kEndQuestionPicture = "question.png";

/// A vessel end that somebody may decide about.
struct QuestionedEnd {
    int number = 0;             ///< in the picture and in texts
    Vec3 place = Vec3::Zero();  ///< [mm]
    double diameter = 0.0;      ///< [mm]
    double share = 0.0;         ///< of the inlet's flow [-]
    double opening = 0.0;       ///< how likely it is an opening [-]
    double sac = 0.0;           ///< how likely it is an aneurysm [-]
    std::string why;            ///< it has the proposed role; may be empty
    EndRole proposal = EndRole::Closed;
    bool in_doubt = false;
    bool counts = false;  ///< it has a share of the flow (kLeastShare), or is in doubt
    /// An answer names it even where that is as proposed, so that it depends on nothing else.
    bool stated = false;
};

/// Which ends are the inlet, open or closed.
struct EndQuestion {
    std::string doubt;  ///< a sentence: "it is not certain that ..."
    std::vector<QuestionedEnd> ends;
};

/// Writes the question with which a preparation stopped: kEndQuestion, which has the ends as
/// `ends --json` does, and kEndQuestionPicture. Does nothing if it stopped for anything else.
/// \param session with the edits before the ends are opened
/// \param recipe with the arguments of the edit that would have opened them
/// \throw IoError, Cancelled
void write_end_question(Session& session, const Recipe& recipe, const PrepareOptions& options,
                        const std::exception& error, const Progress& progress);

/// The question in a preparation's folder; none: there is none, or it cannot be read.
[[nodiscard]] std::optional<EndQuestion> read_end_question(const std::filesystem::path& folder);

}  // namespace vesselbench
