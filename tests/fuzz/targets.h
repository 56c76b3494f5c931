#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace vesselbench::fuzz {

/// What happened to one file.
enum class Verdict {
    Accepted,   ///< it was read
    Refused,    ///< by an error of the program's own, in its own words
    OverLimit,  ///< it asked for more memory than its reader may take
    Contained,  ///< a library ended or failed in the worker process that is there for it
    Finding     ///< anything else
};

struct Reading {
    Verdict verdict = Verdict::Accepted;
    std::string text;  ///< of the error, or what was found
};

/// How files of one format are read.
struct Target {
    /// In this process; a crash there is seen by whoever started it. Null: only the program does.
    /// \throw what the reader throws
    std::function<void(const std::filesystem::path&)> read;
    bool folder = false;      ///< the folder of the file is read
    bool by_library = false;  ///< VTK or GDCM reads it, in a worker process
    bool has_limit = true;    ///< reads under 16 times its size and 256 MiB
    bool program = true;      ///< `vesselbench new` takes it
};

/// By format.
[[nodiscard]] const std::map<std::string, Target>& targets();

/// Reads in this process: what it throws becomes a verdict.
[[nodiscard]] Reading read_here(const Target& target, const std::filesystem::path& file);

/// Runs the program on the file, with a time limit.
[[nodiscard]] Reading read_by_program(const std::string& format, const std::filesystem::path& file);

/// Reads a damaged project and compares it with the good one.
[[nodiscard]] Reading read_project(const std::filesystem::path& damaged,
                                   const std::string& good_content, bool by_rows);

}  // namespace vesselbench::fuzz
