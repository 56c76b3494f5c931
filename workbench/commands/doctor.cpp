#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include <nlohmann/json.hpp>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "gpu/context.h"
#include "gpu/device.h"
#include "workbench/case/json_text.h"
#include "workbench/case/version.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/crash_report.h"
#include "workbench/export/export_formats.h"
#include "workbench/flow/solver_process.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/review/page_file.h"
#include "workbench/review/review_page_bytes.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/worker/sandbox.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kGibi = 1U << 30U;

/// Below them a preparation may stop half way [bytes].
constexpr std::uint64_t kLittleMemory = 2 * kGibi, kLittleDisk = kGibi;

struct Check {
    std::string name;
    std::string value;
    std::string lacking;  ///< what does not work, and how to get it; empty: all is well
};

/// A line of /proc/meminfo [bytes]; 0: it has none.
std::uint64_t memory(const std::string& key) {
    std::ifstream lines("/proc/meminfo");
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(key + ":"))
            return std::strtoull(line.c_str() + key.size() + 1, nullptr, 10) * 1024U;
    return 0;
}

Check memory_check() {
    const std::uint64_t free = memory("MemAvailable");
    return {
        "memory", size_text(free) + " free of " + size_text(memory("MemTotal")),
        free < kLittleMemory ? "large images and meshes may not fit: close other programs" : ""};
}

/// \param place finds the folder, or says why it is unknown
Check disk_check(const std::string& name, fs::path (*place)(std::error_code&)) {
    std::error_code error;
    const fs::path folder = place(error);
    if (error) return {name, "unknown", error.message()};
    const std::uint64_t free = fs::space(folder, error).available;
    if (error) return {name, "unknown", "the folder cannot be read"};
    return {name, size_text(free) + " free",
            free < kLittleDisk ? "projects and meshes may not fit: free some space" : ""};
}

Check opengl_check() {
    try {
        const OffscreenContext context;
        const DeviceLimits limits = current_device().limits;
        return {"OpenGL",
                std::to_string(limits.major) + "." + std::to_string(limits.minor) + " by " +
                    limits.renderer,
                ""};
    } catch (const GpuUnavailable& error) {
        return {"OpenGL", error.what(),
                "there are no pictures and no window: install the graphics card's driver, or "
                "Mesa's (apt install libegl1 libgl1-mesa-dri)"};
    }
}

Check display_check() {
    for (const char* name : {"WAYLAND_DISPLAY", "DISPLAY"})
        if (const char* value = std::getenv(name); value != nullptr && *value != '\0')
            return {"display", value, ""};
    return {"display", "none", "the window cannot open here; the command line works without it"};
}

Check sandbox_check() {
    const Sandbox sandbox = available_sandbox();
    if (sandbox.files && sandbox.calls) return {"sandbox", "files and system calls", ""};
    return {"sandbox",
            sandbox.calls   ? "system calls only"
            : sandbox.files ? "files only"
                            : "none",
            "damaged or hostile input is less confined: this system offers no more"};
}

Check page_check() {
    try {
        require_page(review_page_bytes());
        return {"review page", "built in", ""};
    } catch (const DiagnosedFailure&) {
        return {"review page", "not built in",
                "`review --out` and `export model.html` refuse: build again with npm"};
    }
}

Check program_check(const std::string& name, const std::string& program,
                    const std::string& lacking) {
    const fs::path file = installed_program(program);
    if (!file.empty()) return {name, file.string(), ""};
    return {name, "not found", lacking};
}

Check cgns_check() {
    const bool found = can_write_cgns();
    return {"CGNS", found ? "found" : "not found",
            found ? "" : "`export` writes no CGNS files: apt install libcgns3.4"};
}

Check bundled_check() {
    const bool found = !bundled_case("aneurysm").empty();
    return {"bundled case", found ? "aneurysm" : "not found",
            found ? "" : "`prepare aneurysm` refuses: install again"};
}

Check crash_check() {
    const std::vector<fs::path> reports = crash_reports(state_folder());
    if (reports.empty()) return {"crash reports", "none", ""};
    return {"crash reports",
            counted(reports.size(), "file") + ", the last " + reports.front().string(),
            "please report what happened with that file, then remove it"};
}

std::vector<Check> checks() {
    return {{"vesselbench", version(), ""},
            {"processors", std::to_string(std::thread::hardware_concurrency()), ""},
            memory_check(),
            disk_check("this folder", &fs::current_path),
            disk_check("temporary files", &fs::temp_directory_path),
            opengl_check(),
            display_check(),
            sandbox_check(),
            page_check(),
            bundled_check(),
            program_check("OpenFOAM", "simpleFoam",
                          "cases are written, but cannot be run here: apt install openfoam"),
            program_check("OpenSSH", "ssh-keygen",
                          "signatures cannot be verified: apt install openssh-client"),
            cgns_check(),
            crash_check()};
}

}  // namespace

void check_system(bool json) {
    const std::vector<Check> found = checks();
    if (json) {
        Json rows = Json::array();
        for (const Check& check : found)
            rows.push_back({{"check", check.name},
                            {"ok", check.lacking.empty()},
                            {"value", check.value},
                            {"lacking", check.lacking}});
        std::cout << text_from_json({{"checks", rows}}, 2) << "\n";
        return;
    }
    std::vector<std::vector<std::string>> rows;
    for (const Check& check : found) {
        rows.push_back({check.name, check.value});
        if (!check.lacking.empty()) rows.push_back({"", "! " + check.lacking});
    }
    std::cout << as_columns(rows);
}

}  // namespace vesselbench
