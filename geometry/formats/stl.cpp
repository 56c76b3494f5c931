#include "geometry/formats/stl.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/point_welder.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kCountAt = 80;  // behind the text: the number of triangles
constexpr std::size_t kHeader = kCountAt + sizeof(std::uint32_t);
constexpr std::size_t kRecord = 50;  // normal, three corners (floats), two bytes

Vec3 corner_of(const char* record, std::size_t k) {
    float xyz[3];
    std::memcpy(xyz, record + 12 + 12 * k, sizeof xyz);
    return {xyz[0], xyz[1], xyz[2]};
}

std::uint32_t stated_count(const std::string& bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kCountAt, sizeof count);
    return count;
}

RawSurface read_binary(const std::string& bytes, const std::string& file) {
    const std::size_t count = stated_count(bytes);
    RawSurface raw;
    const std::string_view header = std::string_view(bytes).substr(0, kCountAt);
    raw.unit = stated_unit(header);
    raw.axes = stated_axes(header);
    raw.triangles.reserve(count);
    PointWelder welder(count / 2 + 16);
    for (std::size_t t = 0; t < count; ++t) {
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = corner_of(bytes.data() + kHeader + t * kRecord, k);
            if (!p.allFinite())
                throw InvalidInput(file + ", triangle " + std::to_string(t) + " (byte " +
                                   std::to_string(kHeader + t * kRecord) +
                                   "): a coordinate is not finite; the program that wrote the file "
                                   "failed; export it again");
            triangle[k] = welder.add(p);
        }
        raw.triangles.push_back(triangle);
    }
    raw.positions = welder.take();
    return raw;
}

class TextReader {
public:
    TextReader(const std::string& text, const std::string& file) : scan_(text, file) {}

    RawSurface read() {
        while (scan_.next_line('\0')) {
            const std::string word = keyword();
            if (word == "solid")
                begin_solid();
            else if (word == "facet")
                read_facet();
            else if (word == "endsolid")
                in_solid_ = false;
            else
                scan_.fail("'" + word.substr(0, 40) +
                           "' found instead of solid, facet or endsolid");
        }
        if (in_solid_)
            scan_.fail(
                "the file ends without 'endsolid': it is truncated; copy or download it again");
        raw_.positions = welder_.take();
        if (solid_ == 0) raw_.part_ids.clear();
        return std::move(raw_);
    }

private:
    void begin_solid() {
        if (in_solid_) scan_.fail("'solid' inside a solid");
        in_solid_ = true;
        ++solid_;
        std::string name;
        for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word())
            name += (name.empty() ? "" : " ") + std::string(word);
        raw_.part_names[solid_] = name;
        if (const auto unit = stated_unit(name)) raw_.unit = unit;
        if (const auto axes = stated_axes(name)) raw_.axes = axes;
    }

    void read_facet() {
        Triangle triangle{};
        expect("outer");
        for (VertexId& corner : triangle) {
            expect("vertex");
            const double x = scan_.number("vertex x"), y = scan_.number("vertex y"),
                         z = scan_.number("vertex z");
            corner = welder_.add({x, y, z});
        }
        expect("endloop");
        expect("endfacet");
        raw_.triangles.push_back(triangle);
        raw_.part_ids.push_back(solid_);
    }

    void expect(const char* wanted) {
        if (!scan_.next_line('\0'))
            scan_.fail(std::string("the file ends where '") + wanted +
                       "' is expected: it is truncated; copy or download it again");
        const std::string word = keyword();
        if (word != wanted)
            scan_.fail("'" + word.substr(0, 40) + "' found instead of '" + wanted + "'");
    }

    /// The line's first word as the format spells it: some write capitals, or "end loop".
    std::string keyword() {
        std::string word = lower_case(scan_.word());
        if (word == "end") word += lower_case(scan_.word());
        return word;
    }

    TextScanner scan_;
    RawSurface raw_;
    PointWelder welder_;
    int solid_ = 0;
    bool in_solid_ = false;
};

bool is_text(const std::string& bytes) {
    return std::memchr(bytes.data(), 0, std::min<std::size_t>(bytes.size(), 512)) == nullptr;
}

/// What a file begins with, behind blanks: at most so much of a line.
std::string beginning_of(const std::string& bytes, std::size_t length) {
    const auto at = bytes.find_first_not_of(" \t\r\n");
    if (at == std::string::npos) return "";
    const std::string_view text = std::string_view(bytes).substr(at, length);
    return std::string(text.substr(0, text.find_first_of("\r\n")));
}

/// At most 80 bytes, which is all that the format has room for.
std::string header_text(const std::string& provenance) {
    const std::string unit = "vesselbench UNITS=mm";
    if (provenance.empty()) return unit;
    return unit + ", " + comment_line(provenance, kCountAt - unit.size() - 2);
}

bool looks_like_text(const std::string& bytes) {
    return lower_case(beginning_of(bytes, 5)) == "solid" && is_text(bytes);
}

}  // namespace

RawSurface read_stl(const std::string& path) {
    const std::string bytes = file_content(path), file = bare_name(path);
    const bool fits =
        bytes.size() >= kHeader && bytes.size() >= kHeader + kRecord * stated_count(bytes);
    const bool exact = fits && bytes.size() == kHeader + kRecord * stated_count(bytes);
    if (!exact && looks_like_text(bytes)) return TextReader(bytes, file).read();
    if (!fits && !bytes.empty() && is_text(bytes))
        throw InvalidInput(file + " is no STL file: it is a text that begins with '" +
                           printable(beginning_of(bytes, 20)) + "', not with 'solid'");
    if (bytes.size() < kHeader)
        throw InvalidInput(file + " is too short for an STL file (" + std::to_string(bytes.size()) +
                           " bytes)");
    if (!fits)
        throw InvalidInput(file + " announces " + std::to_string(stated_count(bytes)) +
                           " triangles, but contains only " +
                           std::to_string((bytes.size() - kHeader) / kRecord) +
                           ": it is truncated or not an STL file; copy or download it again");
    RawSurface raw = read_binary(bytes, file);
    if (!exact)
        raw.notes.push_back(
            std::to_string(bytes.size() - kHeader - kRecord * raw.triangles.size()) +
            " bytes after the last triangle were ignored");
    return raw;
}

void write_stl(const Surface& surface, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    std::string bytes(kHeader + kRecord * surface.triangle_count(), '\0');
    const std::string header = header_text(provenance);
    std::memcpy(bytes.data(), header.data(), header.size());
    const auto count = static_cast<std::uint32_t>(surface.triangle_count());
    std::memcpy(bytes.data() + kCountAt, &count, sizeof count);
    char* record = bytes.data() + kHeader;
    LoopProgress rows(progress, surface.triangle_count(), writing_text(path));
    for (const Triangle& t : surface.triangles()) {
        rows.step();
        const Eigen::Vector3f normal = area_normal(surface.points(), t).normalized().cast<float>();
        std::memcpy(record, normal.data(), 12);
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3f p = surface.points()[t[k]].cast<float>();
            std::memcpy(record + 12 + 12 * k, p.data(), 12);
        }
        record += kRecord;
    }
    write_file(path, bytes, progress);
}

}  // namespace vesselbench
