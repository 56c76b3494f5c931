#include "geometry/formats/off.h"

#include "geometry/formats/comment_line.h"
#include "geometry/formats/number_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

class Reader {
public:
    Reader(const std::string& text, const std::string& file) : scan_(text, file) {
        raw_.unit = stated_unit(std::string_view(text).substr(0, 1000));
    }

    RawSurface read() {
        read_counts();
        for (long long i = 0; i < points_; ++i) {
            next("point", i, points_);
            const double x = scan_.number("x"), y = scan_.number("y"), z = scan_.number("z");
            raw_.positions.emplace_back(x, y, z);
        }
        for (long long i = 0; i < faces_; ++i) {
            next("face", i, faces_);
            read_face();
        }
        return std::move(raw_);
    }

private:
    void read_counts() {
        if (!scan_.next_line('#')) scan_.fail("the file is empty");
        const std::string_view word = scan_.word();
        if (word.size() < 3 || word.size() > 6 || word.substr(word.size() - 3) != "OFF")
            scan_.fail("the first word is not OFF");
        std::string_view count = scan_.word();
        if (count == "BINARY")
            scan_.fail("binary OFF is not supported: save it as a text OFF, STL or PLY file");
        if (count.empty()) {
            if (!scan_.next_line('#')) scan_.fail("the counts of points and faces are missing");
            count = scan_.word();
        }
        points_ = scan_.parse_integer(count, "number of points");
        faces_ = scan_.integer("number of faces");
        if (points_ < 0 || faces_ < 0) scan_.fail("a negative number of points or faces");
    }

    void next(const char* what, long long index, long long count) {
        if (!scan_.next_line('#'))
            scan_.fail("the file ends before " + std::string(what) + " " +
                       std::to_string(index + 1) + " of " + std::to_string(count) +
                       ": it is truncated; copy or download it again");
    }

    void read_face() {
        const long long corners = scan_.integer("number of corners");
        if (corners < 3 || corners > points_)
            scan_.fail("a face with " + std::to_string(corners) + " corners");
        polygon_.clear();
        for (long long k = 0; k < corners; ++k) {
            const long long v = scan_.integer("face corner");
            if (v < 0 || v >= points_)
                scan_.fail("a face refers to point " + std::to_string(v) + ", but there are only " +
                           std::to_string(points_) + ": the file is damaged");
            polygon_.push_back(static_cast<VertexId>(v));
        }
        append_polygon(raw_.positions, polygon_, raw_.triangles);
    }

    TextScanner scan_;
    RawSurface raw_;
    std::vector<VertexId> polygon_;
    long long points_ = 0, faces_ = 0;
};

}  // namespace

RawSurface read_off(const std::string& path) {
    const std::string text = file_content(path);
    return Reader(text, bare_name(path)).read();
}

void write_off(const Surface& surface, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    std::string text = "OFF\n# surface of vesselbench UNITS=mm\n";
    if (!provenance.empty()) text += "# " + comment_line(provenance) + "\n";
    text += std::to_string(surface.vertex_count()) + " " +
            std::to_string(surface.triangle_count()) + " 0\n";
    LoopProgress rows(progress, surface.vertex_count() + surface.triangle_count(),
                      writing_text(path));
    for (const Vec3& p : surface.points()) {
        rows.step();
        text += numbers_text(p) + "\n";
    }
    for (const Triangle& t : surface.triangles()) {
        rows.step();
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
                std::to_string(t[2]) + "\n";
    }
    write_file(path, text, progress);
}

}  // namespace vesselbench
