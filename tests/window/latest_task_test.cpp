// One question at a time is answered on another thread; only the last that waits counts.

#include "workbench/window/model/latest_task.h"

#include <chrono>
#include <functional>
#include <future>
#include <new>
#include <optional>

#include <catch2/catch.hpp>

#include "workbench/window/model/background_search.h"

using namespace vesselbench;

namespace {

/// Work that ends when it is let go.
class Gate {
public:
    [[nodiscard]] LatestTask<int>::Work work(int answer) const {
        return [answer, opened = opened_](const Progress&) {
            opened.wait();
            return answer;
        };
    }

    void open() { gate_.set_value(); }

private:
    std::promise<void> gate_;
    std::shared_future<void> opened_ = gate_.get_future().share();
};

/// Asks until something is so, for a minute at most.
void require_soon(const std::function<bool()>& is_so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    bool so = is_so();
    while (!so && std::chrono::steady_clock::now() < end) so = is_so();
    REQUIRE(so);
}

int answer_of(LatestTask<int>& task) {
    std::optional<int> answer;
    require_soon([&] {
        answer = task.take();
        return answer || !task.pending();
    });
    return answer.value_or(0);
}

}  // namespace

SCENARIO("The last question is answered", "[window]") {
    GIVEN("a task that runs, and two questions that wait") {
        LatestTask<int> task(nullptr);
        Gate gate;
        task.begin(gate.work(1));
        task.begin([](const Progress&) { return 2; });
        task.begin([](const Progress&) { return 3; });
        gate.open();
        THEN("the running one and the last one are answered") {
            CHECK(answer_of(task) == 1);
            CHECK(answer_of(task) == 3);
            CHECK_FALSE(task.pending());
        }
    }
    GIVEN("a task that is forgotten while it runs") {
        LatestTask<int> task(nullptr);
        Gate gate;
        task.begin(gate.work(1));
        task.forget();
        THEN("no answer is to come, although nobody asks for it") {
            CHECK_FALSE(task.pending());
            gate.open();
        }
        THEN("the next question is answered after it") {
            task.begin([](const Progress&) { return 2; });
            CHECK(task.pending());
            gate.open();
            CHECK(answer_of(task) == 2);
        }
    }
}

SCENARIO("Work that fails gives a problem instead of an answer", "[window]") {
    LatestTask<int> task(nullptr);
    const auto problem_of = [&](LatestTask<int>::Work work) {
        task.begin(std::move(work));
        require_soon([&] {
            CHECK_FALSE(task.take());
            return !task.pending();
        });
        return task.take_problem();
    };
    CHECK(problem_of([](const Progress&) -> int { throw std::bad_alloc(); }) ==
          "there is not enough memory");
    CHECK(problem_of([](const Progress&) -> int { throw InvalidInput("no such vessel"); }) ==
          "no such vessel");
    CHECK(problem_of([](const Progress&) -> int { throw 5; }) == "an unknown error");
    CHECK(problem_of([](const Progress&) -> int { throw Cancelled(); }).empty());
    THEN("the next question is answered") {
        task.begin([](const Progress&) { return 7; });
        CHECK(answer_of(task) == 7);
        CHECK(task.take_problem().empty());
    }
}

SCENARIO("A search reports why it found nothing", "[window]") {
    GIVEN("a search that fails") {
        BackgroundSearch<int> search(nullptr);
        search.begin([](const Progress&) -> int { throw AlgorithmFailure("no vessel here"); });
        require_soon([&] { return search.update(); });
        THEN("the problem is kept until the next search") {
            CHECK(search.result() == nullptr);
            CHECK(search.problem() == "no vessel here");
            search.begin([](const Progress&) { return 5; });
            CHECK(search.problem().empty());
            require_soon([&] { return search.update(); });
            CHECK(*search.result() == 5);
        }
    }
}
