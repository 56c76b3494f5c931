#include "tests/workbench/room_table.h"

#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vesselbench::test {

namespace {

using Names = std::set<std::string>;
using Words = std::vector<std::string>;

struct Command {
    std::string name;
    Words words;
};

Words words_of(const std::string& text) {
    static const std::regex quote("\"");
    std::istringstream stream(std::regex_replace(text, quote, ""));
    return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<Command> commands_in(const std::string& text) {
    static const std::regex comment("#[^\n]*");
    static const std::regex command(R"re((\w+)[ \t]*\(([^()"]*(?:"[^"]*"[^()"]*)*)\))re");
    const std::string code = std::regex_replace(text, comment, "");
    std::vector<Command> commands;
    for (std::sregex_iterator i(code.begin(), code.end(), command), end; i != end; ++i)
        commands.push_back({(*i)[1], words_of((*i)[2])});
    return commands;
}

/// The words behind each keyword; those before the first keyword are behind "".
std::map<std::string, Words> by_keyword(const Words& words, const Names& keywords) {
    std::map<std::string, Words> parts;
    std::string keyword;
    for (const std::string& word : words)
        if (keywords.contains(word))
            keyword = word;
        else
            parts[keyword].push_back(word);
    return parts;
}

Names own_targets(const Words& words) {
    Names targets;
    for (const std::string& word : words)
        if (word.starts_with("vb_")) targets.insert(word);
    return targets;
}

Words behind_first(const Command& command) {
    return {command.words.begin() + 1, command.words.end()};
}

[[noreturn]] void refuse(const std::string& folder, const Command& command,
                         const std::string& why) {
    std::string text = folder + "/CMakeLists.txt: " + command.name + "(";
    for (const std::string& word : command.words) text += word + " ";
    text.back() = ')';
    throw std::invalid_argument(text + ": " + why);
}

/// Follows the commands of one CMakeLists.txt.
class ListReader {
public:
    ListReader(std::string folder, const Names& files, RoomTable& table)
        : folder_(std::move(folder)), files_(files), table_(table) {}

    void follow(const Command& command) {
        if (command.name == "room") add_room(command);
        if (command.name == "vesselbench_library") add_own_library(command);
        if (command.name == "add_library" || command.name == "add_executable") add_target(command);
        if (command.name == "target_link_libraries") add_links(command);
        if (command.name == "sources_below") set_variable(command);
        if (command.name == "list") filter_variable(command);
    }

private:
    void add_room(const Command& command) {
        auto parts = by_keyword(command.words, {"USES"});
        if (parts[""].size() != 1) refuse(folder_, command, "it is not room(NAME USES ...)");
        const Words& doors = parts["USES"];
        const DeclaredRoom room = {{doors.begin(), doors.end()}, folder_};
        if (!table_.rooms.emplace(parts[""][0], room).second)
            refuse(folder_, command, "there is such a room");
    }

    void add_own_library(const Command& command) {
        auto parts =
            by_keyword(command.words, {"FOLDERS", "WITHOUT", "SOURCES", "PUBLIC", "PRIVATE"});
        if (parts[""].size() != 1) refuse(folder_, command, "words without a keyword");
        if (parts["FOLDERS"].empty() && parts["SOURCES"].empty()) parts["FOLDERS"] = parts[""];
        Names sources = sources_below(parts["FOLDERS"]);
        for (const std::string& without : parts["WITHOUT"]) sources.erase(path_of(without));
        sources.merge(named_sources(command, parts["SOURCES"]));
        Names links = own_targets(parts["PUBLIC"]);
        links.merge(own_targets(parts["PRIVATE"]));
        table_.targets["vb_" + parts[""][0]] = {sources, links};
    }

    void add_target(const Command& command) {
        table_.targets[command.words.at(0)].sources = named_sources(command, behind_first(command));
    }

    void add_links(const Command& command) {
        table_.targets[command.words.at(0)].links.merge(own_targets(behind_first(command)));
    }

    void set_variable(const Command& command) {
        variables_[command.words.at(0)] = sources_below(behind_first(command));
    }

    void filter_variable(const Command& command) {
        const Words& words = command.words;
        const auto variable = words.size() < 2 ? variables_.end() : variables_.find(words[1]);
        if (variable == variables_.end()) return;
        if (words.size() != 5 || words[0] + words[2] + words[3] != "FILTEREXCLUDEREGEX")
            refuse(folder_, command, "of sources, only FILTER ... EXCLUDE REGEX is known");
        const std::regex pattern(words[4]);
        std::erase_if(variable->second, [&](const std::string& source) {
            return std::regex_search(source.substr(folder_.size() + 1), pattern);
        });
    }

    std::string path_of(const std::string& name) const {
        std::string path =
            (std::filesystem::path(folder_) / name).lexically_normal().generic_string();
        while (path.ends_with('/')) path.pop_back();
        return path;
    }

    Names sources_below(const Words& folders) const {
        Names sources;
        for (const std::string& folder : folders)
            for (const std::string& file : files_)
                if (file.ends_with(".cpp") && is_below(file, path_of(folder))) sources.insert(file);
        return sources;
    }

    /// Those that are named, and those of variables; generated ones are left out.
    Names named_sources(const Command& command, const Words& words) const {
        Names sources;
        for (const std::string& word : words) {
            const bool is_variable = word.starts_with("${") && word.ends_with("}");
            const auto variable =
                is_variable ? variables_.find(word.substr(2, word.size() - 3)) : variables_.end();
            if (variable != variables_.end())
                sources.insert(variable->second.begin(), variable->second.end());
            else if (is_variable)
                refuse(folder_, command, word + " is not of sources_below");
            else if (word.ends_with(".cpp") && !word.starts_with("$"))
                sources.insert(path_of(word));
        }
        return sources;
    }

    std::string folder_;
    const Names& files_;
    RoomTable& table_;
    std::map<std::string, Names> variables_;  ///< sources
};

}  // namespace

bool is_below(const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
}

void read_cmake_lists(const std::string& folder, const std::string& text,
                      const std::set<std::string>& files, RoomTable& table) {
    ListReader reader(folder, files, table);
    for (const Command& command : commands_in(text)) reader.follow(command);
}

}  // namespace vesselbench::test
