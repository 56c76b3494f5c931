#pragma once

#include "workbench/session/task.h"

namespace vesselbench {

/// Answers questions of the window step by step, and keeps what serves several of them: an OpenGL
/// context, or what was found for the question before. Made, used and destroyed on the thread of an
/// AnswerTask.
template <class Question, class Answer>
class Answerer {
public:
    Answerer() = default;
    virtual ~Answerer() = default;
    Answerer(const Answerer&) = delete;
    Answerer& operator=(const Answerer&) = delete;

    /// May throw: Cancelled, or why there is no answer.
    virtual void answer(const Question& question, const TaskTurn<Answer>& turn) = 0;

    /// Drops what is kept for other questions.
    virtual void forget() = 0;
};

template <class Question, class Answer>
using AnswerTask = Task<Answer, Answerer<Question, Answer>>;

/// \return the number of the question
template <class Question, class Answer>
std::uint64_t ask(AnswerTask<Question, Answer>& task, Question question) {
    return task.start([question = std::move(question)](Answerer<Question, Answer>& answerer,
                                                       const TaskTurn<Answer>& turn) {
        answerer.answer(question, turn);
    });
}

}  // namespace vesselbench
