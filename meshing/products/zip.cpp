#include "meshing/products/zip.h"

#include <memory>

#include <zip.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr zip_uint16_t kMidnight = 0, kFirstOf1980 = 0x21;
constexpr zip_uint64_t kLargest = 0xFFFFFFFE;

struct SourceFree {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};

using Source = std::unique_ptr<zip_source_t, SourceFree>;

[[noreturn]] void fail(const std::string& what, const zip_error_t& error) {
    zip_error_t copy = error;
    throw AlgorithmFailure("ZIP: " + what + ": " + zip_error_strerror(&copy));
}

void add_part(zip_t* archive, const std::string& name, const std::string& bytes) {
    if (bytes.size() > kLargest) throw InvalidInput("ZIP: " + name + " is too large");
    zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(source);
        fail("'" + name + "' cannot be added", *zip_get_error(archive));
    }
    const auto part = static_cast<zip_uint64_t>(index);
    zip_set_file_compression(archive, part, ZIP_CM_DEFLATE, 0);
    zip_file_set_dostime(archive, part, kMidnight, kFirstOf1980, 0);
}

/// libzip asks while it packs. \param progress a Progress
int is_cancelled(zip_t*, void* progress) {
    return static_cast<const Progress*>(progress)->is_cancelled() ? 1 : 0;
}

std::string content_of(zip_source_t* source) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_source_open(source) != 0 || zip_source_stat(source, &stat) != 0)
        fail("the archive cannot be read back", *zip_source_error(source));
    std::string bytes(stat.size, '\0');
    if (zip_source_read(source, bytes.data(), bytes.size()) !=
        static_cast<zip_int64_t>(bytes.size()))
        fail("the archive cannot be read back", *zip_source_error(source));
    zip_source_close(source);
    return bytes;
}

}  // namespace

std::string zip_archive(const std::vector<std::pair<std::string, std::string>>& parts,
                        const Progress& progress) {
    zip_error_t error;
    zip_error_init(&error);
    const Source source(zip_source_buffer_create(nullptr, 0, 0, &error));
    if (!source) fail("no memory", error);
    zip_source_keep(source.get());
    zip_t* archive = zip_open_from_source(source.get(), ZIP_TRUNCATE, &error);
    if (!archive) {
        zip_source_free(source.get());
        fail("no archive", error);
    }
    zip_register_cancel_callback_with_state(archive, is_cancelled, nullptr,
                                            const_cast<Progress*>(&progress));
    try {
        for (const auto& [name, bytes] : parts) add_part(archive, name, bytes);
        if (zip_close(archive) != 0) {
            progress.check_cancelled();
            fail("the parts cannot be packed", *zip_get_error(archive));
        }
    } catch (...) {
        zip_discard(archive);
        throw;
    }
    return content_of(source.get());
}

}  // namespace vesselbench
