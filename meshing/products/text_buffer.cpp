#include "meshing/products/text_buffer.h"

#include "geometry/formats/atomic_file.h"

namespace vesselbench {

void write_text(const std::filesystem::path& path, std::string_view text) {
    write_file(path.string(), [&](std::ostream& out) {
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
    });
}

}  // namespace vesselbench
