#include "workbench/flow/flow_case.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"
#include "workbench/project/project.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// What the solver needs to go on.
constexpr std::array kSolved = {"U", "p", "phi"};
/// OpenFOAM's last line of a whole file.
constexpr std::string_view kFoamEnd = "// ****";

bool is_case(const fs::path& folder) {
    std::error_code error;
    return fs::is_regular_file(folder / "system" / "controlDict", error);
}

/// Of a file that OpenFOAM writes: its end is there.
bool is_whole_file(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    const std::string text = file_content(file);
    constexpr std::size_t kTail = 120;
    return text.find(kFoamEnd, text.size() > kTail ? text.size() - kTail : 0) != std::string::npos;
}

/// The time folders above 0.
std::map<double, fs::path> times_in(const fs::path& folder) {
    std::map<double, fs::path> times;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        double time = 0.0;
        const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), time);
        if (bad == std::errc() && end == name.data() + name.size() && time > 0.0)
            times[time] = entry.path();
    }
    return times;
}

/// A torn file stops the solver and what joins its parts, even of a field that follows from others.
bool is_whole_time(const fs::path& time) {
    if (!std::ranges::all_of(kSolved,
                             [&](const char* field) { return is_whole_file(time / field); }))
        return false;
    const fs::directory_iterator entries(time);
    return std::all_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
        return !entry.is_regular_file() || is_whole_file(entry.path());
    });
}

}  // namespace

FlowCase find_flow_case(const fs::path& place) {
    const std::string name = bare_name(fs::absolute(place).lexically_normal());
    std::error_code error;
    if (!fs::exists(place, error)) throw InvalidInput("there is no folder '" + name + "'");
    const bool is_project = fs::is_regular_file(place, error) && is_project_file(place);
    const fs::path folder = is_project ? fs::absolute(place).parent_path() : place;
    FlowCase found;
    if (is_case(folder)) found.folder = folder;
    for (const Purpose& purpose : purposes())
        if (purpose.simulates_flow && is_case(folder / purpose.result_file)) {
            found.folder = folder / purpose.result_file;
            found.prepared = folder;
        }
    if (found.folder.empty())
        throw InvalidInput("'" + name +
                           "' holds no OpenFOAM case: give a folder of `prepare --for cfd`, or a "
                           "case that `export` wrote");
    found.record = read_flow_record(found.folder);
    require_recorded_mesh(found.folder, found.record);
    return found;
}

std::optional<double> last_whole_time(const fs::path& folder) {
    const std::map<double, fs::path> times = times_in(folder);
    for (auto time = times.rbegin(); time != times.rend(); ++time)
        if (is_whole_time(time->second)) return time->first;
    return std::nullopt;
}

void remove_broken_times(const fs::path& folder) {
    for (const auto& [time, path] : times_in(folder))
        if (!is_whole_time(path)) fs::remove_all(path);
}

std::string time_name(double time) {
    return formatted(time, "%.9g");
}

}  // namespace vesselbench
