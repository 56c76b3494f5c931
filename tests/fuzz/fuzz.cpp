// Damaged files against every reader (docs/science/reliability.md). scripts/fuzz runs it.
//
//   fuzz [--files N | --minutes M] [--seed S] [--jobs J] [--only FORMAT] [--every N] [--out FOLDER]
//
// File i is made by seed S + i alone. Each is read in a process of ours that may die; every N-th
// (25; 0: none) also by the program, and those on which a library died. Findings are printed with
// their seeds, and their files kept in FOLDER/findings; FOLDER/contained has the files on which a
// library died in the worker process.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <string>
#include <vector>

// The shapes of tests/support warn through Catch2, whose library would bring its own main().
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/whole_file.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/project_specimens.h"
#include "tests/fuzz/targets.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/worker/worker.h"

namespace vesselbench::fuzz {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kBatch = 64;  // files per process
constexpr int kSeconds = 10;          // of CPU time per file
constexpr int kWallSeconds = 240;     // per file: the program may run on it as well
constexpr int kFoundExit = 42;

struct Options {
    std::uint64_t files = 1000;
    double minutes = 0.0;  ///< 0: by files
    std::uint64_t seed = 1;
    unsigned jobs = 1;
    std::uint64_t every = 25;
    std::string only;
    fs::path out;
};

constexpr std::size_t kVerdicts = 5, kFormats = 32;

/// What a child shows its parent, also after its death.
struct Board {
    std::atomic<std::uint64_t> seed;
    std::atomic<bool> by_program;
    std::array<std::array<std::atomic<std::uint64_t>, kVerdicts>, kFormats> counts;
    std::array<char, 4000> finding;
};

Board* new_board() {
    void* memory =
        mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return new (memory) Board{};
}

/// All that is needed to make and read file number `seed`.
class Fuzzer {
public:
    Fuzzer(const Options& options, const fs::path& corpus)
        : options_(options), corpus_(read_corpus(corpus)) {
        for (const auto& [format, target] : targets())
            if (options.only.empty() || format == options.only) formats_.push_back(format);
        for (const Specimen& specimen : corpus_.specimens["project"]) {
            std::ifstream content((corpus.parent_path() / "contents" / specimen.name).string());
            good_[specimen.name] = {std::istreambuf_iterator<char>(content), {}};
        }
    }

    [[nodiscard]] const std::vector<std::string>& formats() const { return formats_; }

    /// Number of the format of a file.
    [[nodiscard]] std::size_t format_of(std::uint64_t seed) const { return seed % formats_.size(); }

    /// Makes the file and reads it; everything lies below `place`.
    Reading run(std::uint64_t seed, const fs::path& place, Board& board) const {
        const std::string& format = formats_[format_of(seed)];
        const Made made = make(seed, place, format);
        board.by_program = false;
        Reading reading = under_limit(targets().at(format), made.file, [&](const Target& target) {
            return format == "project"
                       ? read_project(made.file, good_.at(made.specimen), made.by_rows)
                       : read_here(target, made.file);
        });
        if (!targets().at(format).program || reading.verdict == Verdict::Finding) return reading;
        const std::uint64_t round = seed / formats_.size();
        const bool wanted = options_.every > 0 && round % options_.every == 0;
        return wanted ? by_program(seed, place, board) : reading;
    }

    /// What the program makes of the file.
    Reading by_program(std::uint64_t seed, const fs::path& place, Board& board) const {
        const std::string& format = formats_[format_of(seed)];
        board.by_program = true;
        return read_by_program(format, make(seed, place, format).file);
    }

    /// Makes the file of a seed in an empty <place>/file.
    fs::path make_file(std::uint64_t seed, const fs::path& place) const {
        return make(seed, place, formats_[format_of(seed)]).file;
    }

private:
    struct Made {
        fs::path file;
        std::string specimen;
        bool by_rows = false;
    };

    [[nodiscard]] Made make(std::uint64_t seed, const fs::path& place,
                            const std::string& format) const {
        const fs::path folder = place / "file";
        fs::remove_all(folder);
        fs::create_directories(folder);
        for (const Specimen& beside : corpus_.companions.at(format))
            std::ofstream(folder / beside.name, std::ios::binary) << beside.bytes;
        forest::Dice dice(seed);
        const auto& specimens = corpus_.specimens.at(format);
        const auto draw = [&]() -> const Specimen& {
            return specimens[dice.whole(0, static_cast<int>(specimens.size()) - 1)];
        };
        const Specimen& base = draw();
        Made made{folder / base.name, base.name, format == "project" && dice.chance(0.5)};
        const bool inside = format == "nii.gz" && dice.chance(0.7);
        std::string bytes = inside ? ungzipped(base.bytes) : base.bytes;
        if (!made.by_rows) bytes = mutated(std::move(bytes), draw().bytes, dice);
        std::ofstream(made.file, std::ios::binary) << (inside ? gzipped(bytes) : bytes);
        if (made.by_rows) damage_rows(made.file, seed);
        return made;
    }

    static Reading under_limit(const Target& target, const fs::path& file,
                               const std::function<Reading(const Target&)>& read);

    Options options_;
    Corpus corpus_;
    std::vector<std::string> formats_;
    std::map<std::string, std::string> good_;
};

std::uint64_t data_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmData:")) return std::stoull(line.substr(7)) * 1024;
    return 0;
}

/// As a worker process does: 16 times the file and 256 MiB. A sanitizer needs more for itself.
Reading Fuzzer::under_limit(const Target& target, const fs::path& file,
                            const std::function<Reading(const Target&)>& read) {
#if !defined(__SANITIZE_ADDRESS__)
    if (target.has_limit) {
        constexpr std::uint64_t kBase = std::uint64_t{256} << 20U, kThreads = 300U << 20U;
        const std::uint64_t size = std::max<std::uint64_t>(fs::file_size(file), 1) * 129;
        rlimit limit{};
        getrlimit(RLIMIT_DATA, &limit);
        limit.rlim_cur = data_memory() + kBase + kThreads + 16 * size;
        setrlimit(RLIMIT_DATA, &limit);
    }
#endif
    const Reading reading = read(target);
    rlimit none{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_DATA, &none);
    return reading;
}

/// SIGPROF ends a process that computes for too long, SIGALRM one that waits for too long.
void limit_time(int seconds, int wall_seconds) {
    const itimerval cpu{{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &cpu, nullptr);
    alarm(static_cast<unsigned>(wall_seconds));
}

void show(Board& board, const std::string& text) {
    board.finding.fill('\0');
    std::memcpy(board.finding.data(), text.data(), std::min(text.size(), board.finding.size() - 1));
}

/// The child: reads files until one is a finding, or the batch is done.
[[noreturn]] void read_batch(const Fuzzer& fuzzer, std::uint64_t first, std::uint64_t end,
                             const fs::path& place, Board& board) {
    fs::create_directories(place);
    const int err = open((place / "stderr").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    dup2(err, STDERR_FILENO);
    dup2(err, STDOUT_FILENO);
    std::ofstream said(place.parent_path() / "said.txt", std::ios::app);
    for (std::uint64_t seed = first; seed < end; ++seed) {
        (void)!ftruncate(err, 0);
        board.seed = seed;
        limit_time(kSeconds, kWallSeconds);
        const Reading reading = fuzzer.run(seed, place, board);
        ++board.counts[fuzzer.format_of(seed)][static_cast<std::size_t>(reading.verdict)];
        said << seed << ' ' << fuzzer.formats()[fuzzer.format_of(seed)] << ' '
             << static_cast<int>(reading.verdict) << ' '
             << reading.text.substr(0, reading.text.find('\n')) << std::endl;
        const bool kept = reading.verdict == Verdict::Finding ||
                          (reading.verdict == Verdict::Contained && board.by_program);
        if (!kept) continue;
        show(board, reading.text);
        _exit(reading.verdict == Verdict::Finding ? kFoundExit : kFoundExit + 1);
    }
    _exit(0);
}

/// One running child with its range of files.
struct Slot {
    pid_t child = -1;
    std::uint64_t next = 0, end = 0;
    Board* board = nullptr;
    fs::path place;
};

class Campaign {
public:
    Campaign(Options options, const fs::path& corpus)
        : options_(std::move(options)), fuzzer_(options_, corpus), next_(options_.seed) {}

    /// \return the number of findings
    int run() {
        std::vector<Slot> slots(options_.jobs);
        for (std::size_t i = 0; i < slots.size(); ++i) {
            slots[i].board = new_board();
            slots[i].place = options_.out / ("work-" + std::to_string(i));
        }
        for (bool busy = true; busy;) {
            busy = false;
            for (Slot& slot : slots) busy |= slot.child > 0 || start(slot);
            if (busy) wait_for_one(slots);
        }
        print(slots);
        for (const Slot& slot : slots) fs::remove_all(slot.place);
        return findings_;
    }

private:
    /// \return false if nothing is left to do
    bool start(Slot& slot) {
        if (slot.next == slot.end) {
            if (done()) return false;
            slot.next = next_;
            next_ += kBatch;
            if (options_.minutes <= 0) next_ = std::min(next_, options_.seed + options_.files);
            slot.end = next_;
        }
        slot.board->seed = slot.next;
        slot.child = fork();
        if (slot.child == 0) read_batch(fuzzer_, slot.next, slot.end, slot.place, *slot.board);
        return true;
    }

    [[nodiscard]] bool done() const {
        if (options_.minutes <= 0) return next_ >= options_.seed + options_.files;
        return std::chrono::duration<double>(Clock::now() - begin_).count() > 60 * options_.minutes;
    }

    void wait_for_one(std::vector<Slot>& slots) {
        int status = 0;
        const pid_t ended = waitpid(-1, &status, 0);
        const auto slot = std::ranges::find(slots, ended, &Slot::child);
        if (slot == slots.end()) return;
        slot->child = -1;
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
            slot->next = slot->end;
            return;
        }
        note(*slot, status);
        slot->next = slot->board->seed + 1;
    }

    void note(Slot& slot, int status) {
        const bool told = WIFEXITED(status) && WEXITSTATUS(status) >= kFoundExit &&
                          WEXITSTATUS(status) <= kFoundExit + 1;
        const std::uint64_t seed = slot.board->seed;
        const std::string& format = fuzzer_.formats()[fuzzer_.format_of(seed)];
        std::string text = told ? slot.board->finding.data() : how(status, slot.place);
        bool contained = told && WEXITSTATUS(status) == kFoundExit + 1;
        if (!told) {
            contained = targets().at(format).by_library && !slot.board->by_program;
            ++slot.board->counts[fuzzer_.format_of(seed)][static_cast<std::size_t>(
                contained ? Verdict::Contained : Verdict::Finding)];
        }
        keep(seed, format, text, contained);
    }

    void keep(std::uint64_t seed, const std::string& format, const std::string& text,
              bool contained) {
        const fs::path folder = options_.out / (contained ? "contained" : "findings") /
                                (format + "-" + std::to_string(seed));
        fs::create_directories(folder);
        fuzzer_.make_file(seed, folder);
        std::ofstream(folder / "what.txt") << text << '\n';
        if (contained) return;
        ++findings_;
        std::printf("finding: seed %llu, %s: %s\n", static_cast<unsigned long long>(seed),
                    format.c_str(), text.substr(0, 600).c_str());
        std::fflush(stdout);
    }

    static std::string how(int status, const fs::path& place) {
        std::string text = "exit code " + std::to_string(WEXITSTATUS(status));
        if (WIFSIGNALED(status)) {
            const int signal = WTERMSIG(status);
            text = signal == SIGPROF   ? "hang: over 10 s of CPU time"
                   : signal == SIGALRM ? "hang: waits"
                                       : std::string("signal ") + strsignal(signal);
        }
        return text + "\n" + file_content(place / "stderr");
    }

    void print(const std::vector<Slot>& slots) const {
        std::printf("%-13s %8s %9s %9s %11s %10s %9s\n", "format", "files", "read", "refused",
                    "over limit", "contained", "findings");
        std::array<std::uint64_t, kVerdicts> all{};
        for (std::size_t f = 0; f < fuzzer_.formats().size(); ++f) {
            std::array<std::uint64_t, kVerdicts> sums{};
            for (const Slot& slot : slots)
                for (std::size_t v = 0; v < kVerdicts; ++v) sums[v] += slot.board->counts[f][v];
            for (std::size_t v = 0; v < kVerdicts; ++v) all[v] += sums[v];
            print_row(fuzzer_.formats()[f], sums);
        }
        print_row("all", all);
    }

    static void print_row(const std::string& name, const std::array<std::uint64_t, kVerdicts>& n) {
        const auto number = [&](std::size_t v) { return static_cast<unsigned long long>(n[v]); };
        std::printf("%-13s %8llu %9llu %9llu %11llu %10llu %9llu\n", name.c_str(),
                    number(0) + number(1) + number(2) + number(3) + number(4), number(0), number(1),
                    number(2), number(3), number(4));
    }

    Options options_;
    Fuzzer fuzzer_;
    std::uint64_t next_;
    int findings_ = 0;
    Clock::time_point begin_ = Clock::now();
};

/// In a process of its own: threads of libraries do not survive the forks to come.
bool make_corpus(const fs::path& folder) {
    const pid_t child = fork();
    if (child == 0) {
        try {
            write_corpus(folder);
            const fs::path contents = folder.parent_path() / "contents";
            fs::create_directories(contents);
            for (const auto& entry : fs::directory_iterator(folder / "project")) {
                if (!entry.is_regular_file()) continue;
                const fs::path copy = fs::path(test::temporary_folder()) / "copy.vbench";
                fs::copy_file(entry.path(), copy);  // reading moves through its states
                const std::string content = content_of(copy);
                if (content.empty()) throw std::runtime_error("a project is not reproduced");
                std::ofstream(contents / entry.path().filename()) << content;
            }
            _exit(0);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "fuzz: the corpus cannot be made: %s\n", error.what());
            _exit(1);
        }
    }
    int status = 0;
    waitpid(child, &status, 0);
    return status == 0;
}

int main_of(const std::vector<std::string>& words) {
    Options options;
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
        const std::string &name = words[i], &value = words[i + 1];
        if (name == "--files")
            options.files = std::stoull(value);
        else if (name == "--minutes")
            options.minutes = std::stod(value);
        else if (name == "--seed")
            options.seed = std::stoull(value);
        else if (name == "--jobs")
            options.jobs = static_cast<unsigned>(std::stoul(value));
        else if (name == "--every")
            options.every = std::stoull(value);
        else if (name == "--only")
            options.only = value;
        else if (name == "--out")
            options.out = value;
        else
            return std::fprintf(stderr, "fuzz: unknown option %s\n", name.c_str()), 2;
    }
    if (!options.only.empty() && !targets().contains(options.only))
        return std::fprintf(stderr, "fuzz: no such format: %s\n", options.only.c_str()), 2;
    if (options.out.empty()) options.out = test::temporary_folder();
    options.out = fs::absolute(options.out);
    const fs::path corpus = options.out / "corpus";
    if (!fs::exists(options.out / "contents") && !make_corpus(corpus)) return 1;
    const int findings = Campaign(options, corpus).run();
    std::printf("%d findings\n", findings);
    return findings == 0 ? 0 : 1;
}

}  // namespace

}  // namespace vesselbench::fuzz

int main(int count, char** words) {
    if (count == 2 && std::string(words[1]) == "--worker")
        return vesselbench::worker_main(vesselbench::find_operation);
    return vesselbench::fuzz::main_of({words + 1, words + count});
}
