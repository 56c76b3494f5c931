#include "workbench/window/case/handbook.h"

#include <cctype>
#include <cstdlib>

#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/worker/child_process.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaces[] = {"build/site", "share/doc/vesselbench/html"};
constexpr const char* kStartPage = "index.html";

/// As part of an address (RFC 3986). \param kept beside unreserved characters
std::string percent_encoded(const std::string& text, const std::string& kept) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string encoded;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if ((byte < 0x80 && std::isalnum(byte) != 0) ||
            ("-._~" + kept).find(letter) != std::string::npos)
            encoded += letter;
        else
            encoded += {'%', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
    }
    return encoded;
}

bool has_display() {
    const auto is_set = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

/// A page that leads to an address.
fs::path redirection(const std::string& address) {
    const fs::path file = cache_folder() / "handbook.html";
    make_folder(file.parent_path());
    write_file(file,
               "<!doctype html><meta charset=utf-8><meta http-equiv=refresh content=\"0;url=" +
                   xml_escaped(address) + "\">\n");
    return file;
}

}  // namespace

fs::path handbook_page() {
    const fs::path folder = own_folder(kPlaces, kStartPage);
    return folder.empty() ? fs::path() : folder / kStartPage;
}

std::string handbook_address(const fs::path& page, const std::string& words) {
    const std::string address = "file://" + percent_encoded(page.string(), "/");
    return words.empty() ? address : address + "?q=" + percent_encoded(words, "");
}

bool show_handbook(const fs::path& page, const std::string& words) {
    if (!has_display()) return false;
    const fs::path shown = words.empty() ? page : redirection(handbook_address(page, words));
    // In a session of its own: some browsers run until they are closed.
    Child opener(
        {.command = {"/bin/sh", "-c", "command -v xdg-open && exec setsid -f xdg-open \"$1\"", "sh",
                     shown.string()},
         .ends = {},
         .environment = {}});
    return opener.wait() == 0;
}

}  // namespace vesselbench
