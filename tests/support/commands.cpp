#include "tests/support/commands.h"

#include <array>
#include <cstdio>
#include <filesystem>

#include <sys/wait.h>

#include "tests/support/skip.h"

namespace vesselbench::test {

namespace {

bool installed(const std::string& program) {
    if (program.find('/') != std::string::npos) return std::filesystem::exists(program);
    for (const char* folder : {"/usr/bin/", "/usr/local/bin/"})
        if (std::filesystem::exists(folder + program)) return true;
    return false;
}

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace

std::optional<CommandRun> run_command(const std::string& program,
                                      const std::vector<std::string>& arguments,
                                      const std::string& folder) {
    if (!installed(program)) {
        skip(program + " is not installed");
        return std::nullopt;
    }
    std::string line = "export WM_PROJECT_DIR=/usr/share/openfoam; ";
    if (!folder.empty()) line += "cd " + quoted(folder) + " && ";
    line += quoted(program);
    for (const std::string& argument : arguments) line += " " + quoted(argument);
    FILE* pipe = ::popen((line + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    CommandRun run;
    std::array<char, 4096> block;
    for (std::size_t got = 0; (got = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
        run.output.append(block.data(), got);
    const int status = ::pclose(pipe);
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    return run;
}

}  // namespace vesselbench::test
