#include "geometry/formats/obj.h"

#include "geometry/formats/comment_line.h"
#include "geometry/formats/number_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

class Reader {
public:
    Reader(const std::string& text, const std::string& file)
        : scan_(text, file), lines_(static_cast<std::size_t>(0)) {
        const std::string_view head = std::string_view(text).substr(0, 1000);
        raw_.unit = stated_unit(head);
        raw_.axes = stated_axes(head);
    }

    RawSurface read() {
        while (scan_.next_line('#')) {
            const std::string_view word = scan_.word();
            if (word == "v")
                read_point();
            else if (word == "f")
                read_face();
            else if (word == "g" || word == "o")
                begin_group();
            else
                ++lines_;
        }
        if (raw_.triangles.empty() && raw_.positions.empty() && lines_ > 0)
            scan_.fail("neither points nor faces: this is not an OBJ file");
        if (groups_.size() < 2) raw_.part_ids.clear();
        return std::move(raw_);
    }

private:
    void read_point() {
        const double x = scan_.number("x"), y = scan_.number("y"), z = scan_.number("z");
        raw_.positions.emplace_back(x, y, z);
    }

    void begin_group() {
        const std::string name(scan_.word());
        const auto [at, fresh] = groups_.try_emplace(name, static_cast<int>(groups_.size()) + 1);
        group_ = at->second;
        if (fresh) raw_.part_names[group_] = name;
    }

    VertexId corner(std::string_view word) {
        const long long index = scan_.parse_integer(word.substr(0, word.find('/')), "face corner");
        const auto count = static_cast<long long>(raw_.positions.size());
        const long long at = index > 0 ? index - 1 : count + index;
        if (index == 0 || at < 0 || at >= count)
            scan_.fail("a face refers to point " + std::to_string(index) + ", but only " +
                       std::to_string(count) + " come before it: the file is damaged");
        return static_cast<VertexId>(at);
    }

    void read_face() {
        polygon_.clear();
        for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word())
            polygon_.push_back(corner(word));
        if (polygon_.size() < 3) scan_.fail("a face has fewer than three corners");
        append_polygon(raw_.positions, polygon_, raw_.triangles);
        raw_.part_ids.resize(raw_.triangles.size(), group_);
    }

    TextScanner scan_;
    RawSurface raw_;
    std::map<std::string, int> groups_;
    std::vector<VertexId> polygon_;
    std::size_t lines_;
    int group_ = 0;
};

}  // namespace

RawSurface read_obj(const std::string& path) {
    const std::string text = file_content(path);
    return Reader(text, bare_name(path)).read();
}

void write_obj(const Surface& surface, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    require_plain_names(surface.patches);
    std::string text = "# surface of vesselbench UNITS=mm\n";
    if (!provenance.empty()) text += "# " + comment_line(provenance) + "\n";
    LoopProgress rows(progress,
                      surface.vertex_count() + surface.patches.size() * surface.triangle_count(),
                      writing_text(path));
    for (const Vec3& p : surface.points()) {
        rows.step();
        text += "v " + numbers_text(p) + "\n";
    }
    for (std::size_t label = 0; label < surface.patches.size(); ++label) {
        if (surface.patches.size() > 1) text += "g " + surface.patches[label].name + "\n";
        for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
            rows.step();
            if ((*surface.patch_labels)[t] != label) continue;
            text += "f";
            for (const VertexId v : surface.triangles()[t]) text += " " + std::to_string(v + 1);
            text += "\n";
        }
    }
    write_file(path, text, progress);
}

}  // namespace vesselbench
