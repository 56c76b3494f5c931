#include "meshing/products/threemf.h"

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/diagnosed_error.h"
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

std::string model(const Surface& surface, const std::string& provenance, LoopProgress rows) {
    TextBuffer out;
    out << kXml
        << R"(<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">vesselbench</metadata>
)";
    if (!provenance.empty())
        out << " <metadata name=\"Description\">" << xml_escaped(comment_line(provenance))
            << "</metadata>\n";
    out << R"( <resources>
  <object id="1" type="model">
   <mesh>
    <vertices>
)";
    for (const Vec3& p : surface.points()) {
        rows.step();
        out << "     <vertex x=\"" << p.x() << "\" y=\"" << p.y() << "\" z=\"" << p.z() << "\"/>\n";
    }
    out << "    </vertices>\n    <triangles>\n";
    for (const auto& [a, b, c] : surface.triangles()) {
        rows.step();
        out << "     <triangle v1=\"" << a << "\" v2=\"" << b << "\" v3=\"" << c << "\"/>\n";
    }
    out << "    </triangles>\n   </mesh>\n  </object>\n </resources>\n <build>\n  <item "
           "objectid=\"1\"/>\n </build>\n</model>\n";
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
