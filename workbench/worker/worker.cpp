#include "workbench/worker/worker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/project/serialization.h"
#include "workbench/project/stored_text.h"
#include "workbench/worker/child_process.h"
#include "workbench/worker/input_files.h"
#include "workbench/worker/sandbox.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// The worker's ends: request on stdin, outcome and progress on these; stdout and stderr go nowhere.
constexpr int kOutcome = 3;
constexpr int kProgress = 4;
constexpr int kPollMilliseconds = 20;
constexpr auto kProgressInterval = std::chrono::milliseconds(20);
constexpr auto kRepeatInterval = std::chrono::seconds(1);

// The sanitizers' shadow memory needs more address space than any limit, and their reports need
// files, programs and ptrace.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

enum class Ending : std::uint8_t {
    Done = 1,
    Usage,
    Input,
    Io,
    Algorithm,
    Gpu,
    Cancel,
    Memory,
    Broken
};

/// Large scenes take seconds: asks between pieces whether it was cancelled.
void write_pieces(int descriptor, std::span<const std::byte> bytes, const Progress& progress) {
    constexpr std::size_t kPiece = std::size_t{16} << 20;
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(kPiece, bytes.size()))) {
        progress.check_cancelled();
        write_all(descriptor, bytes.first(std::min(kPiece, bytes.size())));
    }
}

/// The content of a file in memory, without a copy of it.
class Mapping {
public:
    explicit Mapping(int descriptor) {
        struct stat info {};

        if (fstat(descriptor, &info) != 0 || info.st_size <= 0) return;
        const auto size = static_cast<std::size_t>(info.st_size);
        void* address = mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
        if (address == MAP_FAILED)
            throw IoError("cannot pass a scene to or from a worker process: out of memory");
        bytes_ = {static_cast<const std::byte*>(address), size};
    }

    ~Mapping() {
        if (!bytes_.empty()) munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    }

    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
};

void write_request(int descriptor, const Operation& operation, const Scene& scene,
                   const Arguments& arguments, const WorkerOptions& options,
                   const Progress& progress) {
    ByteWriter head;
    head.put<std::uint64_t>(options.memory_limit);
    head.put<std::uint64_t>(reader_memory(operation, arguments).value_or(0));
    head.put_text(operation.name);
    head.put_text(stored_text(arguments));
    write_all(descriptor, head.bytes());
    write_scene(scene, {}, [&](std::span<const std::byte> bytes) {
        write_pieces(descriptor, bytes, progress);
    });
}

Bytes outcome_bytes(const Outcome& outcome, const std::vector<ScenePart>& known) {
    ByteWriter writer;
    writer.put(Ending::Done);
    writer.put_text(outcome.report ? stored_text(*outcome.report) : "");
    writer.put_text(stored_text(outcome.resolved));
    writer.put_text(stored_text(diagnostics_json(outcome.warnings)));
    writer.put_text(outcome.device);
    writer.append(encode_scene(outcome.scene, known));
    return writer.take();
}

std::vector<Diagnostic> read_diagnostics(ByteReader& reader) {
    constexpr const char* kName = "the diagnostics";
    return diagnostics_from(json_from_text(reader.get_text(), kName, kLargestStoredJson), kName);
}

Outcome read_outcome(ByteReader& reader, const std::vector<ScenePart>& known,
                     const Progress& progress) {
    Outcome outcome;
    const std::string report = reader.get_text();
    if (!report.empty())
        outcome.report =
            std::make_shared<const Json>(json_from_text(report, "a report", kLargestStoredJson));
    outcome.resolved = arguments_from_stored(reader.get_text());
    outcome.warnings = read_diagnostics(reader);
    outcome.device = reader.get_text();
    outcome.scene = decode_scene(reader.get_bytes(reader.left()), known, progress);
    return outcome;
}

/// In the environment of every worker.
constexpr const char* kWorkerMark = "VESSELBENCH_WORKER";

/// Libraries print what they think of a file, up to asserts: nothing for a user.
ChildSetup worker_setup(std::vector<std::string> command, const Descriptor& request,
                        const Descriptor& outcome, const Descriptor& progress) {
    ChildSetup setup{.command = std::move(command),
                     .ends = {{request.number(), STDIN_FILENO},
                              {outcome.number(), kOutcome},
                              {progress.number(), kProgress}},
                     .environment = {std::string(kWorkerMark) + "=1"}};
    if (kSanitized)
        setup.ends.insert(setup.ends.end(),
                          {{STDERR_FILENO, STDOUT_FILENO}, {STDERR_FILENO, STDERR_FILENO}});
    return setup;
}

/// Passes the worker's progress lines on until it closes its end, and repeats the last one where
/// none comes: a log shows that a long step still runs.
/// \param what the worker does, until it says so itself
/// \return false after the deadline
bool follow(int descriptor, const Progress& progress, std::string what,
            Clock::time_point deadline) {
    std::string text;
    double fraction = 0.0;
    Clock::time_point last = Clock::now();
    std::array<char, 4096> buffer{};
    while (Clock::now() < deadline) {
        progress.check_cancelled();
        pollfd waiting{descriptor, POLLIN, 0};
        if (poll(&waiting, 1, kPollMilliseconds) <= 0) {
            if (Clock::now() - last < kRepeatInterval) continue;
            progress.report(fraction, what);
            last = Clock::now();
            continue;
        }
        const auto got = read(descriptor, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return true;
        text.append(buffer.data(), static_cast<std::size_t>(got));
        for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
            const std::size_t from = std::min(text.find(' ') + 1, end);
            fraction = std::clamp(std::strtod(text.c_str(), nullptr), 0.0, 1.0);
            what = text.substr(from, end - from);
            progress.report(fraction, what);
            last = Clock::now();
            text.erase(0, end + 1);
        }
    }
    return false;
}

/// What may make a surface usable on which an operation breaks.
constexpr const char* kRepair = "repair";

[[noreturn]] void throw_broken(const Operation& operation, const Arguments& arguments,
                               const std::string& what) {
    if (const auto file = file_read_by(operation, arguments))
        throw InvalidInput(operation.name + " " + what + " while reading " + *file +
                           ": the file is probably damaged; the project is unchanged");
    Diagnostic broken{
        .code = "operation-broke", .operation = operation.name, .words = {{"what", what}}};
    if (operation.name != kRepair) broken.remedies = {{.operation = kRepair}};
    throw DiagnosedFailure(std::move(broken));
}

/// Of the classes that may have diagnostics. \param diagnostics empty: it has none
template <class Error>
[[noreturn]] void throw_error(const std::string& text, std::vector<Diagnostic> diagnostics) {
    if (diagnostics.empty()) throw Error(text);
    throw DiagnosedError<Error>(std::move(diagnostics));
}

[[noreturn]] void throw_ending(Ending ending, const std::string& text,
                               std::vector<Diagnostic> diagnostics) {
    switch (ending) {
        case Ending::Usage:
            throw_error<UsageError>(text, std::move(diagnostics));
        case Ending::Input:
            throw_error<InvalidInput>(text, std::move(diagnostics));
        case Ending::Io:
            throw IoError(text);
        case Ending::Gpu:
            throw GpuUnavailable(text);
        case Ending::Cancel:
            throw Cancelled();
        default:
            throw_error<AlgorithmFailure>(text, std::move(diagnostics));
    }
}

/// Somebody stopped the whole group of processes: no fault of a file or an operation.
bool stopped_by_signal(int status) {
    if (!WIFSIGNALED(status)) return false;
    const int signal = WTERMSIG(status);
    return signal == SIGTERM || signal == SIGINT || signal == SIGHUP || signal == SIGQUIT;
}

std::string how_it_ended(int status) {
    if (WIFSIGNALED(status)) return std::string("crashed (") + strsignal(WTERMSIG(status)) + ")";
    return "ended early (code " + std::to_string(WEXITSTATUS(status)) + ")";
}

/// What a worker may need: all of it, or what reading its files may take.
std::string memory_text(const WorkerOptions& options, const Operation& operation,
                        const Arguments& arguments) {
    const auto reading = reader_memory(operation, arguments);
    if (!reading || (options.memory_limit > 0 && options.memory_limit < *reading))
        return size_text(options.memory_limit);
    return size_text(*reading) + " for a file of this size (save it uncompressed if it is good)";
}

/// The worker's report of an error thrown by the operation.
template <class Run>
Bytes outcome_or_error(Run run) {
    const auto error = [](Ending ending, const std::exception& failure) {
        ByteWriter writer;
        writer.put(ending);
        writer.put_text(failure.what());
        const auto* diagnosed = dynamic_cast<const Diagnosed*>(&failure);
        writer.put_text(stored_text(diagnostics_json(
            diagnosed == nullptr ? std::vector<Diagnostic>() : diagnosed->diagnostics())));
        return writer.take();
    };
    try {
        return run();
    } catch (const UsageError& e) {
        return error(Ending::Usage, e);
    } catch (const InvalidInput& e) {
        return error(Ending::Input, e);
    } catch (const IoError& e) {
        return error(Ending::Io, e);
    } catch (const GpuUnavailable& e) {
        return error(Ending::Gpu, e);
    } catch (const Cancelled& e) {
        return error(Ending::Cancel, e);
    } catch (const std::bad_alloc& e) {
        return error(Ending::Memory, e);
    } catch (const AlgorithmFailure& e) {
        return error(Ending::Algorithm, e);
    } catch (const std::exception& e) {
        return error(Ending::Broken, e);  // from a library: it names neither place nor remedy
    }
}

void limit(int resource, std::size_t bytes) {
    const rlimit value{bytes, bytes};
    setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

/// Writable memory that this process has now [bytes]; 0 if unknown.
std::uint64_t memory_now() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmData:")) return std::stoull(line.substr(7)) * 1024;
    return 0;
}

/// During its lifetime, this process may take so much more memory. Unlike the address space, this
/// counts what can be written to, so that libraries and reserved memory of threads do not matter.
class MemoryBudget {
public:
    explicit MemoryBudget(std::uint64_t bytes) {
        constexpr std::uint64_t kStack = std::uint64_t{9} << 20;  // of a thread, with its arena
        const std::uint64_t own = memory_now();
        if (bytes == 0 || own == 0 || kSanitized) return;
        set(own + bytes + kStack * std::thread::hardware_concurrency());
    }

    ~MemoryBudget() { set(RLIM_INFINITY); }

    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

private:
    static void set(std::uint64_t bytes) {
        rlimit now{};
        if (getrlimit(RLIMIT_DATA, &now) != 0) return;
        now.rlim_cur = std::min<rlim_t>(bytes, now.rlim_max);
        setrlimit(RLIMIT_DATA, &now);
    }
};

/// Writes "fraction text" lines, at a readable rate.
Progress::Receiver progress_lines() {
    return [last = Clock::time_point{}](double fraction, std::string_view what) mutable {
        if (Clock::now() - last < kProgressInterval) return;
        last = Clock::now();
        std::string line = std::to_string(fraction) + " " + std::string(what);
        std::replace(line.begin(), line.end(), '\n', ' ');
        write_all(kProgress, std::as_bytes(std::span(line += '\n')));
    };
}

Bytes run_request(const OperationLookup& find) {
    const Mapping request(STDIN_FILENO);
    ByteReader reader(request.bytes());
    const auto memory = reader.get<std::uint64_t>();
    const auto reading = reader.get<std::uint64_t>();
    if (memory > 0 && !kSanitized) limit(RLIMIT_AS, memory);
    const Operation& operation = find(reader.get_text());
    const auto arguments =
        CheckedArguments::from_parent_process(arguments_from_stored(reader.get_text()));
    if (!kSanitized) enter_sandbox(places_read_by(operation, arguments));
    const Scene scene = decode_scene(reader.get_bytes(reader.left()));
    Progress progress(progress_lines(), {});
    const Outcome outcome = [&] {
        const MemoryBudget budget(reading);
        return run_here(operation, scene, arguments, progress);
    }();
    return outcome_bytes(outcome, take_apart(scene).parts);
}

/// An answer that cannot be written is replaced by a short one that says why.
void write_answer(const Bytes& answer) {
    try {
        write_all(kOutcome, answer);
    } catch (const IoError&) {
        const Bytes why = outcome_or_error([]() -> Bytes { throw; });
        lseek(kOutcome, 0, SEEK_SET);
        write_all(kOutcome, why);
    }
}

}  // namespace

Outcome run_in_worker(const Operation& operation, const Scene& scene,
                      const CheckedArguments& arguments, const Progress& progress,
                      const WorkerOptions& options) {
    // A program that does not answer --worker would start itself without end.
    if (std::getenv(kWorkerMark) != nullptr)
        throw std::logic_error("a worker starts a worker: main() has to answer --worker");
    auto command = options.command;
    if (command.empty()) command = {"/proc/self/exe", "--worker"};
    const Descriptor request = memory_file("vesselbench-request");
    const Descriptor answer = memory_file("vesselbench-outcome");
    write_request(request.number(), operation, scene, arguments, options, progress);
    lseek(request.number(), 0, SEEK_SET);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) ends.fill(-1);
    const Descriptor reading = moved_up(ends[0]);
    Descriptor writing = moved_up(ends[1]);
    Child child(worker_setup(std::move(command), request, answer, writing));
    writing.reset();

    if (!follow(reading.number(), progress, operation.name, Clock::now() + options.time_limit))
        throw_broken(operation, arguments,
                     "took longer than " + std::to_string(options.time_limit.count()) + " s");
    const int status = child.wait();
    if (stopped_by_signal(status)) throw Cancelled();
    const Mapping bytes(answer.number());
    if (status != 0 || bytes.bytes().empty())
        throw_broken(operation, arguments, how_it_ended(status));
    ByteReader reader(bytes.bytes());
    const auto ending = static_cast<Ending>(reader.get<std::uint8_t>());
    if (ending == Ending::Memory)
        throw_broken(
            operation, arguments,
            "needs more memory than its limit of " + memory_text(options, operation, arguments));
    if (ending == Ending::Broken)
        throw_broken(operation, arguments, "failed (" + reader.get_text() + ")");
    if (ending != Ending::Done) {
        const std::string text = reader.get_text();
        throw_ending(ending, text, read_diagnostics(reader));
    }
    return read_outcome(reader, take_apart(scene).parts, progress);
}

int worker_main(const OperationLookup& find) {
    if (fcntl(kOutcome, F_GETFD) < 0 || fcntl(kProgress, F_GETFD) < 0) return 2;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // no worker outlives its session
    limit(RLIMIT_CORE, 0);
    std::signal(SIGXFSZ, SIG_IGN);  // a failed write is an answer, too
    try {
        write_answer(outcome_or_error([&] { return run_request(find); }));
    } catch (const std::exception&) {
        return 1;
    }
    return 0;
}

}  // namespace vesselbench
