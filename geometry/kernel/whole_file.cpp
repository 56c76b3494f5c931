#include "geometry/kernel/whole_file.h"

#include <algorithm>
#include <fstream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/regular_file.h"

namespace vesselbench {

namespace fs = std::filesystem;

std::string writing_text(const fs::path& path) {
    return "writing " + bare_name(path);
}

std::string file_content(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) throw IoError(bare_name(path) + " is a folder, not a file");
    refuse_special_file(path);
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw IoError("cannot open " + bare_name(path) + ": check that it exists and is readable");
    file.seekg(0, std::ios::end);
    const auto size = file.tellg();
    if (size < 0) throw IoError("cannot read " + bare_name(path));
    std::string content(static_cast<std::size_t>(size), '\0');
    file.seekg(0);
    file.read(content.data(), size);
    if (!file)
        throw IoError("reading " + bare_name(path) + " stopped after " +
                      std::to_string(file.gcount()) + " bytes");
    return content;
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
    PendingFiles files;
    files.add_stream(path, write);
    files.commit();
}

void write_file(const fs::path& path, std::string_view bytes, const Progress& progress) {
    constexpr std::size_t kPiece = std::size_t{4} << 20;  // a few milliseconds
    write_file(path, [&](std::ostream& out) {
        for (; !bytes.empty(); bytes.remove_prefix(std::min(kPiece, bytes.size()))) {
            progress.check_cancelled();
            out.write(bytes.data(), static_cast<std::streamsize>(std::min(kPiece, bytes.size())));
        }
        progress.check_cancelled();  // its content still has to reach the disk
    });
}

}  // namespace vesselbench
