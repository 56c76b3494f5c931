// Random edits, kills and replays (docs/science/reliability.md). scripts/soak runs it.
//
//   soak [--minutes M] [--kills N] [--seed S] [--out FOLDER]   until both are reached; prints
//   figures soak edit PROJECT FILES EXPORTS SEED                       edits a project until it is
//   killed
//
// Each round starts an editor on the round's project, kills it between two of its lines or within
// the action that follows, and opens the project here: nothing but the action in progress may be
// missing. Every few rounds the project's current state is replayed and built again from nothing.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

// The shapes of tests/support warn through Catch2, whose library would bring its own main().
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/pending_files.h"
#include "tests/soak/random_edits.h"
#include "tests/support/shapes.h"
#include "workbench/case/history.h"
#include "workbench/operations/table.h"
#include "workbench/session/compaction.h"
#include "workbench/worker/worker.h"

namespace vesselbench::soak {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// What a project holds: never less than what was committed.
struct Held {
    std::size_t states = 0, edits = 0, results = 0;
    StateId current = 0;

    bool operator==(const Held&) const = default;
};

Held held_by(const Session& session) {
    const std::shared_ptr<const Snapshot> snapshot = session.snapshot();
    const History& history = *snapshot->history;
    return {history.states().size(), history.edits().size(), history.results().size(),
            history.current()};
}

std::string to_line(const Held& held) {
    std::ostringstream line;
    line << held.states << ' ' << held.edits << ' ' << held.results << ' ' << held.current;
    return line.str();
}

/// The editor: says "begin" before each action, and what the project holds after it.
int edit(const fs::path& project, const fs::path& folder, const fs::path& exports,
         std::uint64_t seed) {
    const SmallFiles files(folder);
    RandomEditor editor(seed, files);
    editor.set_export_folder(exports);
    Session session = fs::exists(project) ? Session::open(project, table_options())
                                          : Session::create(project, table_options());
    const auto say = [](const std::string& line) {
        std::puts(line.c_str());
        std::fflush(stdout);
    };
    try {
        if (!session.read_only_reason().empty())
            throw std::runtime_error("the project is held: " + session.read_only_reason());
        say("held " + to_line(held_by(session)));
        while (true) {
            say("begin");
            const std::string what = editor.act(session);
            say("did " + what);
            if (!editor.reason().empty()) say("since " + editor.reason());
            say("held " + to_line(held_by(session)));
        }
    } catch (const std::exception& error) {
        say(std::string("finding ") + error.what());
        return 1;
    }
}

/// An editor process and what it has said.
class Editor {
public:
    Editor(const std::vector<std::string>& words, const fs::path& err) {
        int ends[2];
        if (pipe(ends) != 0) throw std::runtime_error("no pipe");
        pid_ = fork();
        if (pid_ == 0) {
            dup2(ends[1], STDOUT_FILENO);
            close(ends[0]);
            close(ends[1]);
            if (std::freopen(err.c_str(), "w", stderr) == nullptr) _exit(126);
            std::vector<char*> pointers;
            for (const std::string& word : words)
                pointers.push_back(const_cast<char*>(word.c_str()));
            pointers.push_back(nullptr);
            execv("/proc/self/exe", pointers.data());
            _exit(127);
        }
        close(ends[1]);
        output_ = ends[0];
    }

    ~Editor() {
        kill();
        close(output_);
    }

    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    /// Listens for a while, or until its end. \return false if it has ended
    bool listen(std::chrono::milliseconds time) {
        const auto end = Clock::now() + time;
        for (auto now = Clock::now(); now < end; now = Clock::now()) {
            pollfd waiting{output_, POLLIN, 0};
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - now);
            if (poll(&waiting, 1, static_cast<int>(left.count()) + 1) > 0 && !take()) return false;
        }
        return true;
    }

    /// Takes all that it said before its end. \return its status from waitpid()
    int kill() {
        if (pid_ <= 0) return status_;
        ::kill(pid_, SIGKILL);
        waitpid(pid_, &status_, 0);
        pid_ = -1;
        while (take()) {
        }
        return status_;
    }

    [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

private:
    bool take() {
        char buffer[4096];
        const auto got = read(output_, buffer, sizeof buffer);
        if (got <= 0) return false;
        text_.append(buffer, static_cast<std::size_t>(got));
        for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
            lines_.push_back(text_.substr(0, end));
            text_.erase(0, end + 1);
        }
        return true;
    }

    pid_t pid_ = -1;
    int output_ = -1, status_ = 0;
    std::string text_;
    std::vector<std::string> lines_;
};

/// The editor's last words about the project.
struct LastWords {
    Held held;
    bool known = false;   ///< it said what the project holds
    bool within = false;  ///< an action had begun
    std::string finding;
};

LastWords last_words(const std::vector<std::string>& lines, Tally& tally) {
    LastWords last;
    for (const std::string& line : lines) {
        std::istringstream words(line);
        std::string first, what;
        words >> first;
        if (first == "begin") last.within = true;
        if (first == "finding") last.finding = line;
        if (first == "held") {
            words >> last.held.states >> last.held.edits >> last.held.results >> last.held.current;
            last.known = true;
            last.within = false;
        }
        if (first != "did") continue;
        words >> what;
        ++tally[line.ends_with(" done") ? what : line.substr(line.rfind(' ') + 1)];
        ++tally["actions"];
        if (what == "apply" && words >> what && line.ends_with(" done")) ++tally["applied " + what];
    }
    return last;
}

struct Options {
    double minutes = 0.0;
    std::size_t kills = 0;
    std::uint64_t seed = 1;
    fs::path out;
};

class Soak {
public:
    explicit Soak(const Options& options)
        : options_(options),
          dice_(options.seed),
          files_(options.out / "files"),
          seed_(options.seed) {
        fs::create_directories(exports());
    }

    /// \return the number of findings
    std::size_t run() {
        for (begin_ = Clock::now(); !done(); ++seed_) {
            if (rounds_ == 0) begin_project();
            try {
                round();
            } catch (const std::exception& error) {
                find(error.what());
            }
        }
        if (rounds_ > 0) end_project();
        print();
        return findings_;
    }

private:
    [[nodiscard]] bool done() const {
        const double minutes = std::chrono::duration<double>(Clock::now() - begin_).count() / 60;
        return minutes >= options_.minutes && tally_.contains("kills") &&
               tally_.at("kills") >= options_.kills;
    }

    [[nodiscard]] fs::path exports() const { return options_.out / "exports"; }

    [[nodiscard]] fs::path project() const { return options_.out / "project" / "case.vbench"; }

    void begin_project() {
        fs::remove_all(project().parent_path());
        fs::create_directories(project().parent_path());
        for (const auto& file : fs::directory_iterator(files_.folder()))
            fs::copy(file.path(), project().parent_path() / file.path().filename());
        rounds_ = dice_.whole(3, 15);
        project_seed_ = seed_;
        known_ = {};
    }

    void find(const std::string& text) {
        ++findings_;
        const fs::path kept = options_.out / ("finding-" + std::to_string(findings_));
        std::error_code ignored;
        fs::remove_all(kept, ignored);
        fs::copy(project().parent_path(), kept, fs::copy_options::recursive, ignored);
        fs::copy(options_.out / "stderr", kept / "stderr", ignored);
        std::printf("finding: project %llu, round %llu: %s\n",
                    static_cast<unsigned long long>(project_seed_),
                    static_cast<unsigned long long>(seed_), text.c_str());
        std::fflush(stdout);
    }

    void round() {
        Editor editor(
            {"soak", "edit", project(), files_.folder(), exports(), std::to_string(seed_)},
            options_.out / "stderr");
        const bool ended = !editor.listen(std::chrono::milliseconds(
            static_cast<int>(dice_.log_between(dice_.chance(0.2) ? 1.0 : 60.0, 1500.0))));
        const int status = editor.kill();
        const LastWords last = last_words(editor.lines(), tally_);
        if (ended) {
            find(last.finding.empty()
                     ? "the editor ended by itself, status " + std::to_string(status)
                     : last.finding);
            known_ = {};
        } else {
            ++tally_["kills"];
            ++tally_[last.within ? "kills within an action" : "kills between actions"];
            if (last.known) known_ = last.held;
            check_opened(last);
        }
        if (--rounds_ == 0) end_project();
    }

    /// Opens the project after a kill: nothing but the action in progress may be missing.
    void check_opened(const LastWords& last) {
        if (!fs::exists(project())) {
            if (last.known) find("the project is gone");
            return;
        }
        Session session = Session::open(project(), table_options());
        if (!session.read_only_reason().empty())
            find("after a kill: " + session.read_only_reason());
        const Held held = held_by(session);
        const bool less = held.states < known_.states || held.edits < known_.edits ||
                          held.results < known_.results;
        const bool more = held.states > known_.states + 1 || held.edits > known_.edits + 1;
        const bool same = held == known_;
        if (less || (last.known && (more || (!last.within && !same))))
            find("after a kill the project holds " + to_line(held) + " instead of " +
                 to_line(known_));
        known_ = held;
        (void)session.known_scene(held.current);
        write_and_look(session);
    }

    /// What a killed process left is removed by the next one that writes there.
    void write_and_look(Session& session) {
        PendingFiles files;
        files.add_text(exports() / "log.txt", std::to_string(session.log().size()));
        files.commit();
        for (const fs::path& folder : {exports(), project().parent_path()})
            for (const auto& entry : fs::directory_iterator(folder))
                if (entry.path().filename().string().starts_with(".partial-"))
                    find(entry.path().filename().string() + " is left after a kill");
    }

    void end_project() {
        rounds_ = 0;
        if (!fs::exists(project())) return;
        {
            Session session = Session::open(project(), table_options());
            for (const std::string& text : unreproduced(session, files_, table_options()))
                find(text);
            tally_["edits replayed"] += session.log().size();
            ++tally_["projects replayed"];
        }
        if (!dice_.chance(0.3)) return;
        (void)compact_project(project());
        Session session = Session::open(project(), table_options());
        for (const std::string& text : unreproduced(session, files_, table_options()))
            find("after compacting: " + text);
        ++tally_["compactions"];
    }

    void print() const {
        for (const auto& [what, count] : tally_) std::printf("%-28s %9zu\n", what.c_str(), count);
        std::printf("%-28s %9.1f\n", "minutes",
                    std::chrono::duration<double>(Clock::now() - begin_).count() / 60);
        std::printf("%-28s %9zu\n", "findings", findings_);
    }

    Options options_;
    forest::Dice dice_;
    SmallFiles files_;
    std::uint64_t seed_, project_seed_ = 0;
    int rounds_ = 0;  // left for the project
    Held known_;
    Tally tally_;
    std::size_t findings_ = 0;
    Clock::time_point begin_ = Clock::now();
};

int main_of(const std::vector<std::string>& words) {
    if (words.size() == 5 && words[0] == "edit")
        return edit(words[1], words[2], words[3], std::stoull(words[4]));
    Options options;
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
        const std::string &name = words[i], &value = words[i + 1];
        if (name == "--minutes")
            options.minutes = std::stod(value);
        else if (name == "--kills")
            options.kills = std::stoul(value);
        else if (name == "--seed")
            options.seed = std::stoull(value);
        else if (name == "--out")
            options.out = value;
        else
            return std::fprintf(stderr, "soak: unknown option %s\n", name.c_str()), 2;
    }
    if (options.out.empty()) options.out = test::temporary_folder();
    fs::create_directories(options.out);
    options.out = fs::canonical(options.out);
    return Soak(options).run() == 0 ? 0 : 1;
}

}  // namespace

}  // namespace vesselbench::soak

int main(int count, char** words) {
    using namespace vesselbench;
    if (count == 2 && std::string(words[1]) == "--worker") return worker_main(find_operation);
    return soak::main_of({words + 1, words + count});
}
