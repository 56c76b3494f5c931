#include "meshing/products/zip.h"

#include <cstdint>
#include <stdexcept>

#include <zlib.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::uint64_t kLargest = 0xFFFFFFFE;
constexpr std::uint16_t kVersion = 20, kDeflated = 8, kMidnight = 0, kFirstOf1980 = 0x21;

void put16(std::string& out, std::uint16_t value) {
    out += static_cast<char>(value & 0xFF);
    out += static_cast<char>(value >> 8);
}

void put32(std::string& out, std::uint32_t value) {
    put16(out, static_cast<std::uint16_t>(value & 0xFFFF));
    put16(out, static_cast<std::uint16_t>(value >> 16));
}

std::string deflated(const std::string& bytes) {
    z_stream stream = {};
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL,
                     Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib does not start");
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    const int state = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (state != Z_STREAM_END) throw std::runtime_error("zlib cannot pack");
    return packed;
}

// The fields that the local and the central header have in common.
std::string common_fields(const std::string& name, const std::string& bytes,
                          const std::string& packed) {
    std::string fields;
    for (const std::uint16_t field :
         {kVersion, std::uint16_t{0}, kDeflated, kMidnight, kFirstOf1980})
        put16(fields, field);
    put32(fields, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(bytes.data()),
                                                   static_cast<uInt>(bytes.size()))));
    put32(fields, static_cast<std::uint32_t>(packed.size()));
    put32(fields, static_cast<std::uint32_t>(bytes.size()));
    put16(fields, static_cast<std::uint16_t>(name.size()));
    put16(fields, 0);  // no extra field
    return fields;
}

}  // namespace

std::string zip_archive(const std::vector<std::pair<std::string, std::string>>& parts) {
    std::string archive, directory;
    for (const auto& [name, bytes] : parts) {
        if (bytes.size() > kLargest || archive.size() > kLargest)
            throw InvalidInput("ZIP: " + name + " is too large");
        const std::string packed = deflated(bytes);
        const std::string fields = common_fields(name, bytes, packed);
        put32(directory, 0x02014B50);
        put16(directory, kVersion);
        directory += fields;
        for (int k = 0; k < 3; ++k) put16(directory, 0);  // comment, disk, inner attributes
        put32(directory, 0);                              // outer attributes
        put32(directory, static_cast<std::uint32_t>(archive.size()));
        directory += name;
        put32(archive, 0x04034B50);
        archive += fields + name + packed;
    }
    const auto start = static_cast<std::uint32_t>(archive.size());
    archive += directory;
    put32(archive, 0x06054B50);
    put32(archive, 0);  // disks
    for (int k = 0; k < 2; ++k) put16(archive, static_cast<std::uint16_t>(parts.size()));
    put32(archive, static_cast<std::uint32_t>(directory.size()));
    put32(archive, start);
    put16(archive, 0);  // no comment
    return archive;
}

}  // namespace vesselbench
