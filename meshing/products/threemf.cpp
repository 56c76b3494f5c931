#include "meshing/products/threemf.h"

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/text_buffer.h"
#include "meshing/products/zip.h"

namespace vesselbench {

namespace {

constexpr const char* kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

std::string content_types() {
    return std::string(kXml) +
           R"(<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";
}

std::string relationships() {
    return std::string(kXml) +
           R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";
}

/// A closed body; one of several has a name, "part 1", by which slicers list it.
void add_mesh(TextBuffer& out, const Surface& surface, std::size_t id, bool named,
              LoopProgress& rows) {
    out << "  <object id=\"" << id << "\" type=\"model\"";
    if (named) out << " name=\"part " << id << "\"";
    out << ">\n   <mesh>\n    <vertices>\n";
    for (const Vec3& p : surface.points()) {
        rows.step();
        out << "     <vertex x=\"" << p.x() << "\" y=\"" << p.y() << "\" z=\"" << p.z() << "\"/>\n";
    }
    out << "    </vertices>\n    <triangles>\n";
    for (const auto& [a, b, c] : surface.triangles()) {
        rows.step();
        out << "     <triangle v1=\"" << a << "\" v2=\"" << b << "\" v3=\"" << c << "\"/>\n";
    }
    out << "    </triangles>\n   </mesh>\n  </object>\n";
}

/// The parts as one object, so that slicers keep them where they are to each other.
void add_assembly(TextBuffer& out, std::size_t parts) {
    out << "  <object id=\"" << parts + 1 << "\" type=\"model\">\n   <components>\n";
    for (std::size_t id = 1; id <= parts; ++id)
        out << "    <component objectid=\"" << id << "\"/>\n";
    out << "   </components>\n  </object>\n";
}

/// The closed bodies of a surface; the surface itself where one of its parts bounds a cavity, which
/// belongs to the body around it.
std::vector<Surface> bodies_of(const Surface& surface) {
    const Components parts = connected_components(*surface.topology);
    if (parts.count() == 1) return {surface};
    std::vector<Surface> bodies;
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
        std::vector<bool> keep;
        for (const std::uint32_t of : parts.of_triangle) keep.push_back(of == part);
        bodies.push_back(select_triangles(surface, keep));
        if (volume(bodies.back()) < 0.0) return {surface};
    }
    return bodies;
}

/// \return id of the object to be built
std::size_t add_objects(TextBuffer& out, const Surface& surface, LoopProgress& rows) {
    const std::vector<Surface> bodies = bodies_of(surface);
    const bool several = bodies.size() > 1;
    for (std::size_t i = 0; i < bodies.size(); ++i) add_mesh(out, bodies[i], i + 1, several, rows);
    if (!several) return 1;
    add_assembly(out, bodies.size());
    return bodies.size() + 1;
}

std::string model(const Surface& surface, const std::string& provenance, LoopProgress rows) {
    TextBuffer out;
    out << kXml
        << R"(<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">vesselbench</metadata>
)";
    if (!provenance.empty())
        out << " <metadata name=\"Description\">" << xml_escaped(comment_line(provenance))
            << "</metadata>\n";
    out << " <resources>\n";
    const std::size_t built = add_objects(out, surface, rows);
    out << " </resources>\n <build>\n  <item objectid=\"" << built << "\"/>\n </build>\n</model>\n";
    return out.text();
}

/// \throw InvalidInput that names the first place and the remedy, unless the surface bounds a solid
void require_solid(const Surface& surface) {
    const Connectivity state = connectivity(*surface.topology);
    if (!state.manifold || !state.oriented)
        throw DiagnosedInput({.code = "print-not-a-solid",
                              .words = {{"property", state.manifold ? "oriented" : "manifold"}},
                              .remedies = {{.operation = "repair"}}});
    if (state.closed) return;
    const auto loops = surface.topology->boundary_loops();
    throw DiagnosedInput(
        {.code = "print-has-holes",
         .place = surface.points()[loops.front().front()],
         .figures = {{"holes", static_cast<double>(loops.size())}},
         .remedies = {
             {.operation = "clip-opening"}, {.operation = "fill-hole"}, {.operation = "repair"}}});
}

}  // namespace

void write_3mf(const Surface& surface, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    if (surface.empty()) throw InvalidInput("3MF: the surface has no triangles");
    require_solid(surface);
    const LoopProgress rows(progress.part(0.0, 0.5),
                            surface.vertex_count() + surface.triangle_count(), writing_text(path));
    write_file(path,
               zip_archive({{"[Content_Types].xml", content_types()},
                            {"_rels/.rels", relationships()},
                            {"3D/3dmodel.model", model(surface, provenance, rows)}},
                           progress),
               progress);
}

}  // namespace vesselbench
