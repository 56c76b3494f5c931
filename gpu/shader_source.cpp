#include "gpu/shader_source.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

const std::string& text_of(const std::map<std::string, std::string>& texts,
                           const std::string& file) {
    const auto text = texts.find(file);
    if (text == texts.end()) throw GpuUnavailable("there is no shader " + file);
    return text->second;
}

/// Name of the file that a line includes by a directive; empty if it does not.
std::string included_by(const std::string& line, const std::string& directive) {
    const std::string start = directive + " \"";
    if (line.rfind(start, 0) != 0) return "";
    return line.substr(start.size(), line.find('"', start.size()) - start.size());
}

void append_file(const std::map<std::string, std::string>& texts, const std::string& file,
                 ShaderSource& source) {
    const std::string number = std::to_string(source.files.size());
    source.files.push_back(file);
    std::istringstream lines(text_of(texts, file));
    int line_number = 0;
    // #version must come first, so no #line before it
    if (number != "0") source.text += "#line 1 " + number + "\n";
    for (std::string line; std::getline(lines, line);) {
        ++line_number;
        const std::string once = included_by(line, "#include"), again = included_by(line, "#again");
        if (!once.empty() || !again.empty()) {
            const bool is_there = std::ranges::find(source.files, once) != source.files.end();
            if (!is_there) append_file(texts, again.empty() ? once : again, source);
            source.text += "#line " + std::to_string(line_number + 1) + " " + number + "\n";
        } else {
            source.text += line + "\n";
        }
    }
}

std::string line_of(const std::string& text, std::size_t number) {
    std::istringstream lines(text);
    std::string line;
    for (std::size_t i = 0; i < number; ++i)
        if (!std::getline(lines, line)) return "";
    return line;
}

}  // namespace

ShaderSource assemble_shader(const std::map<std::string, std::string>& texts,
                             const std::string& file) {
    ShaderSource source;
    append_file(texts, file, source);
    return source;
}

std::string explained_log(const std::map<std::string, std::string>& texts,
                          const ShaderSource& source, const std::string& log) {
    // Mesa: 0:12(5): error: ...   NVIDIA: 0(12) : error C0000: ...   AMD: ERROR: 0:12: ...
    const std::regex place(R"(^(?:ERROR: |WARNING: )?(\d+)[:(](\d+)(?:\(\d+\)|\))?\s*:\s*(.*)$)");
    std::istringstream lines(log);
    std::string explained;
    for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        const bool known =
            std::regex_match(line, found, place) && std::stoul(found[1]) < source.files.size();
        if (!known) {
            explained += line + "\n";
            continue;
        }
        const std::string& file = source.files[std::stoul(found[1])];
        explained += file + ":" + found[2].str() + ": " + found[3].str() + "\n    " +
                     line_of(text_of(texts, file), std::stoul(found[2])) + "\n";
    }
    return explained;
}

}  // namespace vesselbench
