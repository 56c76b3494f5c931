#include "workbench/window/core/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/pending_files.h"
#include "workbench/case/json_text.h"
#include "workbench/window/case/local_time.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFile = "settings.json";
/// The layers by their names in the file.
constexpr std::array<std::pair<const char*, bool ShownLayers::*>, 6> kLayers = {
    {{"edges", &ShownLayers::edges},
     {"flat", &ShownLayers::flat},
     {"source", &ShownLayers::source},
     {"centerlines", &ShownLayers::centerlines},
     {"names", &ShownLayers::names},
     {"anchors", &ShownLayers::anchors}}};

/// \return false if it cannot be
bool written(const fs::path& folder, const std::string& text) {
    try {
        fs::create_directories(folder);
        PendingFiles files;
        // The names of projects are often those of patients.
        fs::permissions(files.add_text(folder / kFile, text),
                        fs::perms::owner_read | fs::perms::owner_write);
        files.commit();
    } catch (const std::exception&) {
        return false;
    }
    return true;
}

Json json_of(const PanelSizes& panels) {
    Json json = {{"quarters", panels.quarters}};
    for (const auto& [name, panel] : kPanels) {
        const PanelSize& size = panels[panel];
        Json entry = {{"folded", size.folded}};
        if (size.share) entry["share"] = *size.share;
        json[name] = entry;
    }
    return json;
}

PanelSizes panels_in(const Json& json) {
    PanelSizes panels;
    panels.quarters = json.value("quarters", false);
    for (const auto& [name, panel] : kPanels) {
        const Json entry = json.value(name, Json::object());
        panels[panel].folded = entry.value("folded", false);
        if (entry.contains("share"))
            panels[panel].share = std::clamp(entry.at("share").get<double>(), 0.0, 1.0);
    }
    return panels;
}

fs::path whole_path(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(file, error);
    return error ? file : whole;
}

}  // namespace

Settings::Settings(fs::path folder) : folder_(std::move(folder)), saving_(nullptr) {
    try {
        read();
    } catch (const std::exception&) {  // the window opens with its defaults
        recent_.clear();
    }
    refresh();
}

Settings::~Settings() {
    saving_.wait();
}

void Settings::read() {
    if (!fs::exists(folder_ / kFile)) return;
    const Json json = json_from_file(folder_ / kFile);
    dark = json.value("theme", "dark") != "light";
    scale = std::clamp(json.value("scale", 1.0), kScales.front(), kScales.back());
    for (const Json& shown : json.value("layers", Json::array()))
        for (const auto& [name, layer] : kLayers)
            if (shown == name) layers.*layer = true;
    panels = panels_in(json.value("panels", Json::object()));
    const Json person = json.value("reviewer", Json::object());
    reviewer = person.value("name", std::string());
    reviewer_role = person.value("role", std::string());
    for (const Json& entry : json.value("recent", Json::array()))
        recent_.push_back(
            {entry.at("file").get<std::string>(), entry.value("opened", std::string())});
}

void Settings::remember(const fs::path& project) {
    const fs::path file = whole_path(project);
    forget(file);
    recent_.insert(recent_.begin(), {.file = file, .opened = local_time("%Y-%m-%d %H:%M")});
    if (recent_.size() > kMostRecent) recent_.resize(kMostRecent);
}

void Settings::forget(const fs::path& project) {
    const fs::path file = whole_path(project);
    std::erase_if(recent_, [&](const RecentProject& entry) { return entry.file == file; });
}

void Settings::refresh() {
    std::error_code ignored;
    for (RecentProject& entry : recent_) entry.missing = !fs::exists(entry.file, ignored);
}

void Settings::change_scale(int steps) {
    const auto nearest = std::ranges::min_element(
        kScales, {}, [&](double offered) { return std::abs(offered - scale); });
    const auto index = static_cast<int>(nearest - kScales.begin()) + steps;
    scale = kScales.at(
        static_cast<std::size_t>(std::clamp(index, 0, static_cast<int>(kScales.size()) - 1)));
}

std::string Settings::text() const {
    Json list = Json::array();
    for (const RecentProject& entry : recent_)
        list.push_back({{"file", entry.file.string()}, {"opened", entry.opened}});
    Json shown = Json::array();
    for (const auto& [name, layer] : kLayers)
        if (layers.*layer) shown.push_back(name);
    const Json json = {{"theme", dark ? "dark" : "light"},
                       {"scale", scale},
                       {"layers", shown},
                       {"panels", json_of(panels)},
                       {"reviewer", {{"name", reviewer}, {"role", reviewer_role}}},
                       {"recent", list}};
    return text_from_json(json, 2) + "\n";
}

bool Settings::save() const {
    saving_.wait();
    return written(folder_, text());
}

void Settings::save_soon() {
    static_cast<void>(saving_.poll());
    saving_.start_after([folder = folder_, text = text()](const Progress&) {
        static_cast<void>(written(folder, text));
        return Nothing{};
    });
}

}  // namespace vesselbench
