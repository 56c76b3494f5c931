#include "geometry/formats/format.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "geometry/kernel/regular_file.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

bool ends_in_one_of(const std::string& path, const std::vector<std::string>& suffixes) {
    const std::string name = lower_case(fs::path(path).filename().string());
    return std::ranges::any_of(suffixes, [&](const auto& s) { return name.ends_with(s); });
}

bool is_folder(const std::string& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

}  // namespace

bool is_named_for_reading(const Format& format, const std::string& path) {
    if (is_folder(path)) return !format.folder.empty();
    return ends_in_one_of(path, format.suffixes) || ends_in_one_of(path, format.also_read);
}

bool is_named_for_writing(const Format& format, const std::string& path) {
    if (is_folder(path) || lower_suffix(path).empty()) return !format.folder.empty();
    return ends_in_one_of(path, format.suffixes);
}

bool content_fits(const Format& format, const std::string& path) {
    if (!format.sniff) return true;
    refuse_special_file(path);
    std::ifstream in(path, std::ios::binary);
    std::string head(kSniffedBytes, '\0');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    return format.sniff(head);
}

std::string lower_suffix(const std::string& path) {
    const fs::path name = fs::path(path).filename();
    const std::string last = lower_case(name.extension().string());
    const std::string inner = lower_case(name.stem().extension().string());
    return last == ".gz" ? inner + last : last;
}

}  // namespace vesselbench
