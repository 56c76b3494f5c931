// Work in the background: the newest counts, what was cancelled is never reported, and nothing
// outlives its owner.

#include "workbench/session/task.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"

using namespace vesselbench;
using namespace std::chrono_literals;

namespace {

/// Work that ends when it is let go, whether it is cancelled or not.
class Gate {
public:
    [[nodiscard]] std::function<int(const Progress&)> work(int answer) const {
        return [answer, begun = begun_, opened = opened_](const Progress&) {
            *begun = true;
            opened.wait();
            return answer;
        };
    }

    void wait_for_begin() const {
        while (!*begun_) std::this_thread::sleep_for(1ms);
    }

    void open() { gate_.set_value(); }

private:
    std::shared_ptr<std::atomic<bool>> begun_ = std::make_shared<std::atomic<bool>>(false);
    std::promise<void> gate_;
    std::shared_future<void> opened_ = gate_.get_future().share();
};

/// Work that ends with its cancellation.
int run_until_cancelled(const Progress& progress) {
    while (true) {
        progress.check_cancelled();
        std::this_thread::sleep_for(1ms);
    }
}

std::function<int(const Progress&)> give(int answer) {
    return [answer](const Progress&) { return answer; };
}

/// Asks until something is so, for a minute at most.
void require_soon(const std::function<bool()>& is_so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    bool so = is_so();
    while (!so && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(1ms);
        so = is_so();
    }
    REQUIRE(so);
}

/// The next answer; 0: none is to come.
template <class Kept>
int answer_of(Task<int, Kept>& task) {
    require_soon([&] { return task.poll() || !task.pending(); });
    return task.take().value_or(0);
}

}  // namespace

SCENARIO("What waits behind the running work is replaced", "[session][task]") {
    GIVEN("work that runs, and two that wait") {
        Task<int> task(nullptr);
        Gate gate;
        task.start_after(gate.work(1));
        task.start_after(give(2));
        task.start_after(give(3));
        gate.open();
        THEN("the running one and the last one are answered") {
            CHECK(answer_of(task) == 1);
            CHECK(answer_of(task) == 3);
            CHECK_FALSE(task.pending());
        }
    }
    GIVEN("both have ended before they are polled") {
        std::atomic<int> woken = 0;
        Task<int> task([&] { ++woken; });
        task.start_after(give(1));
        task.start_after(give(2));
        task.wait();
        require_soon([&] { return woken == 2; });
        THEN("each is seen, and the owner is woken for the second") {
            REQUIRE(task.poll());
            CHECK(*task.newest() == 1);
            CHECK(task.pending());
            CHECK(woken == 3);
            REQUIRE(task.poll());
            CHECK(*task.newest() == 2);
            CHECK_FALSE(task.poll());
        }
    }
}

SCENARIO("The newest work wins", "[session][task]") {
    GIVEN("work that runs and does not heed a cancel") {
        Gate gate;
        Task<int> task(nullptr);
        task.start(gate.work(1));
        gate.wait_for_begin();
        WHEN("newer work begins") {
            task.start(give(2));
            gate.open();
            THEN("only the newer one is answered") {
                CHECK(answer_of(task) == 2);
                CHECK_FALSE(task.pending());
                CHECK_FALSE(task.poll());
            }
        }
        WHEN("it is dropped") {
            task.drop();
            CHECK_FALSE(task.pending());
            gate.open();
            THEN("it is never reported, and the next is answered after it") {
                task.start(give(2));
                CHECK(answer_of(task) == 2);
            }
        }
        WHEN("it is forgotten, and nobody asks any more") {
            task.forget();
            CHECK_FALSE(task.pending());
            gate.open();
        }
    }
    GIVEN("much work, begun faster than it ends") {
        Task<int> task(nullptr);
        int last = 0;
        bool ascending = true;
        const auto take = [&] {
            if (!task.poll()) return;
            ascending = ascending && *task.newest() > last;
            last = *task.newest();
        };
        for (int i = 1; i <= 500; ++i) {
            task.start(give(i));
            if (i % 7 == 0) take();
        }
        require_soon([&] {
            take();
            return !task.pending();
        });
        THEN("an older answer never follows a newer one") {
            CHECK(ascending);
            CHECK(last == 500);
        }
    }
    GIVEN("work that was answered, but not polled") {
        Task<int> task(nullptr);
        task.start(give(1));
        task.wait();
        task.start(run_until_cancelled);
        THEN("the answer is seen while newer work runs") {
            REQUIRE(task.poll());
            CHECK(*task.newest() == 1);
            CHECK(task.pending());
        }
        THEN("a cancel that is to be reported ends the newer work") {
            task.cancel();
            require_soon([&] { return task.ended(); });
            CHECK(task.state() == TaskState::Cancelled);
            CHECK(task.poll());
            CHECK(*task.newest() == 1);
            CHECK(task.problem().empty());
            CHECK_FALSE(task.pending());
        }
    }
}

SCENARIO("Work that fails gives a problem instead of an answer", "[session][task]") {
    Task<int> task(nullptr);
    const auto problem_of = [&](std::function<int(const Progress&)> work) {
        task.start(std::move(work));
        require_soon([&] { return task.poll() || !task.pending(); });
        CHECK_FALSE(task.take());
        return task.problem();
    };
    CHECK(problem_of([](const Progress&) -> int { throw std::bad_alloc(); }) ==
          "there is not enough memory");
    CHECK(problem_of([](const Progress&) -> int { throw InvalidInput("no such vessel"); }) ==
          "no such vessel");
    CHECK(problem_of([](const Progress&) -> int { throw 5; }) == "an unknown error");
    CHECK(problem_of([](const Progress&) -> int { throw Cancelled(); }).empty());
    THEN("the next work is answered") {
        task.start(give(7));
        CHECK(answer_of(task) == 7);
        CHECK(task.problem().empty());
    }
    THEN("the problem and the answer before are kept until they are forgotten") {
        task.start(give(7));
        require_soon([&] { return task.poll(); });
        task.start([](const Progress&) -> int { throw InvalidInput("too thin"); });
        require_soon([&] { return task.poll(); });
        CHECK(task.problem() == "too thin");
        CHECK(*task.newest() == 7);
        task.start(give(8));
        require_soon([&] { return task.poll(); });
        CHECK(task.problem().empty());
        task.forget();
        CHECK(task.newest() == nullptr);
    }
}

namespace {

using Thread = std::thread::id;

/// Counts what happens to what a thread keeps.
struct Counts {
    std::atomic<int> made = 0, forgotten = 0, destroyed = 0;
    std::atomic<bool> elsewhere = false;  ///< on another thread than it was made on
};

class Kept {
public:
    explicit Kept(Counts& counts) : counts_(counts) { ++counts_.made; }

    ~Kept() {
        check_thread();
        ++counts_.destroyed;
    }

    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;

    int count() {
        check_thread();
        return ++used_;
    }

    void forget() {
        check_thread();
        ++counts_.forgotten;
        used_ = 0;
    }

private:
    void check_thread() const {
        if (std::this_thread::get_id() != thread_) counts_.elsewhere = true;
    }

    Counts& counts_;
    Thread thread_ = std::this_thread::get_id();
    int used_ = 0;
};

}  // namespace

SCENARIO("A thread keeps what serves several works", "[session][task]") {
    Counts counts;
    const auto count = [](Kept& kept, const TaskTurn<int>& turn) { turn.send(kept.count()); };
    {
        Task<int, Kept> task(nullptr, [&] { return std::make_unique<Kept>(counts); });
        task.forget();
        CHECK(counts.made == 0);
        task.start(count);
        CHECK(answer_of(task) == 1);
        task.start(count);
        CHECK(answer_of(task) == 2);
        task.forget();
        CHECK_FALSE(task.pending());
        task.start(count);
        CHECK(answer_of(task) == 1);
        CHECK(counts.forgotten == 1);
        CHECK(counts.destroyed == 0);
    }
    THEN("it is made, used and destroyed on that thread") {
        CHECK(counts.made == 1);
        CHECK(counts.destroyed == 1);
        CHECK_FALSE(counts.elsewhere);
    }
}

SCENARIO("Work may send several answers", "[session][task]") {
    GIVEN("work that sends a second answer when nothing newer comes") {
        Task<int> task(nullptr);
        const auto work = [](int first, std::chrono::milliseconds rest) {
            return [=](const TaskTurn<int>& turn) {
                turn.send(first);
                if (turn.rests(rest)) turn.send(first + 1);
            };
        };
        WHEN("nothing comes") {
            task.start(work(1, 1ms));
            THEN("the second one is the last") {
                require_soon([&] {
                    task.poll();
                    return !task.pending();
                });
                CHECK(*task.newest() == 2);
            }
        }
        WHEN("newer work comes while it rests") {
            const auto number = task.start(work(10, std::chrono::minutes(10)));
            require_soon([&] { return task.poll(); });
            CHECK(*task.newest() == 10);
            CHECK(task.pending());
            CHECK(task.start(work(20, 1ms)) == number + 1);
            THEN("it ends at once, and is not heard of again") {
                require_soon([&] {
                    if (task.poll()) CHECK(*task.newest() >= 20);
                    return !task.pending();
                });
                CHECK(*task.newest() == 21);
            }
        }
    }
}

SCENARIO("A task cancels its work and waits for its end when it is destroyed", "[session][task]") {
    std::atomic<bool> alive = true, ran_late = false;
    std::atomic<int> ended = 0;
    {
        Task<int> task([&] {
            if (!alive) ran_late = true;
            ++ended;
        });
        std::atomic<bool> begun = false;
        task.start([&](const Progress& progress) {
            begun = true;
            return run_until_cancelled(progress);
        });
        while (!begun) std::this_thread::sleep_for(1ms);
        task.start_after([&](const Progress&) {
            ran_late = true;
            return 1;
        });
    }
    alive = false;
    CHECK(ended == 2);  // what waited was told of, too
    CHECK_FALSE(ran_late);
}

SCENARIO("A request may be awaited by several threads", "[session][task]") {
    TaskThread thread;
    Gate gate;
    std::vector<std::thread> readers;
    std::atomic<int> sum = 0;
    {
        const Task<int> request(thread, gate.work(5), "");
        for (int i = 0; i < 4; ++i)
            readers.emplace_back([&sum, request] { sum += request.result(); });
        CHECK_FALSE(request.wait_for(1ms));
    }
    gate.open();
    for (std::thread& reader : readers) reader.join();
    CHECK(sum == 20);
}

SCENARIO("A thread makes the calls that are added", "[session][task]") {
    GIVEN("a thread that ends when it is idle") {
        TaskThread thread;
        WHEN("several threads add calls") {
            std::atomic<int> made = 0;
            std::vector<std::thread> adders;
            for (int t = 0; t < 4; ++t)
                adders.emplace_back([&] {
                    for (int i = 0; i < 200; ++i) {
                        const auto run =
                            std::make_shared<TaskRun>([&](const Progress&) { ++made; });
                        thread.add(run);
                        if (i % 3 == 0) run->wait();
                    }
                });
            for (std::thread& adder : adders) adder.join();
            THEN("each is made once") {
                require_soon([&] { return thread.idle(); });
                CHECK(made == 800);
            }
        }
    }
    GIVEN("a thread that is busy") {
        TaskThread thread(TaskThread::WhenIdle::Waits);
        Gate gate;
        const Task<int> busy(thread, gate.work(1), "");
        gate.wait_for_begin();
        WHEN("calls with the same word are added") {
            const auto held = std::make_shared<int>(0);
            const Task<int> older(
                thread, [held](const Progress&) { return *held; }, "picture");
            const Task<int> other(thread, give(2), "figures");
            const Task<int> newer(thread, give(3), "picture");
            THEN("the last of them is made, and the others are freed at once") {
                CHECK(older.state() == TaskState::Cancelled);
                CHECK(held.use_count() == 1);
                CHECK_THROWS_AS(older.result(), Cancelled);
                gate.open();
                CHECK(newer.result() == 3);
                CHECK(other.result() == 2);
            }
        }
        WHEN("a call holds something") {
            const auto held = std::make_shared<int>(4);
            const Task<int> request(
                thread, [held](const Progress&) { return *held; }, "");
            gate.open();
            THEN("it is freed before its end is seen") {
                CHECK(request.result() == 4);
                CHECK(held.use_count() == 1);
            }
        }
    }
}
