#include "workbench/export/products.h"

#include <algorithm>
#include <functional>
#include <map>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/glb.h"
#include "meshing/products/gmsh.h"
#include "meshing/products/openfoam_case.h"
#include "meshing/products/threemf.h"
#include "meshing/products/vtu.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/near_names.h"
#include "workbench/export/flow_parameters.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// The flow as a row like those of the operation table: the same checks and texts serve it.
Operation openfoam() {
    return {.name = "openfoam", .parameters = flow_parameters()};
}

std::string lower_suffix(const fs::path& file) {
    std::string suffix = file.extension().string();
    std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
    return suffix;
}

const VolumeMesh& volume_mesh_of(const Scene& scene) {
    if (!scene.volume_mesh)
        throw InvalidInput("there is no volume mesh in this variant: use tetrahedralize");
    return *scene.volume_mesh;
}

void write_as_surface(PendingFiles& files, const fs::path& file, const Scene& scene) {
    write_surface(surface_of(scene), files.add(file).string());
}

void write_as_openfoam(PendingFiles& files, const fs::path& folder, const Scene& scene,
                       const CfdParameters& flow) {
    const VolumeMesh& mesh = volume_mesh_of(scene);
    write_openfoam_case(files.add(folder), mesh, flow);
}

using Writer = std::function<void(PendingFiles&, const fs::path&, const Scene&)>;

const std::map<std::string, Writer>& writers() {
    static const std::map<std::string, Writer> table = {
        {".stl", write_as_surface},
        {".ply", write_as_surface},
        {".obj", write_as_surface},
        {".off", write_as_surface},
        {".vtp", write_as_surface},
        {".vtu",
         [](PendingFiles& files, const fs::path& file, const Scene& scene) {
             const VolumeMesh& mesh = volume_mesh_of(scene);
             write_vtu(mesh, files.add(file));
         }},
        {".msh",
         [](PendingFiles& files, const fs::path& file, const Scene& scene) {
             const VolumeMesh& mesh = volume_mesh_of(scene);
             write_msh(mesh, files.add(file));
         }},
        {".3mf", [](PendingFiles& files, const fs::path& file,
                    const Scene& scene) { write_3mf(surface_of(scene), files.add(file)); }},
        {".glb", [](PendingFiles& files, const fs::path& file, const Scene& scene) {
             write_glb(surface_of(scene), files.add(file));
         }}};
    return table;
}

fs::path without_last_slash(const fs::path& file) {
    return file.has_filename() ? file : file.parent_path();
}

}  // namespace

CfdParameters take_flow_parameters(std::vector<std::string>& texts) {
    const Operation table = openfoam();
    const std::string prefix = table.name + ".";
    std::vector<std::string> own;
    for (const std::string& text : texts)
        if (text.starts_with(prefix)) own.push_back(text.substr(prefix.size()));
    std::erase_if(texts, [&](const std::string& text) { return text.starts_with(prefix); });
    return flow_from(checked_arguments(table, arguments_from_texts(table, own)));
}

std::vector<std::string> write_products(PendingFiles& files, const fs::path& folder,
                                        const Scene& scene, const std::string& purpose,
                                        const CfdParameters& flow) {
    std::vector<std::string> names = {"surface.vtp", "surface.stl"};
    if (purpose == "cfd") names.insert(names.end(), {"volume.vtu", "volume.msh", "openfoam"});
    if (purpose == "rp") names.insert(names.end(), {"print.stl", "print.3mf"});
    for (const std::string& name : names) export_scene(files, folder / name, scene, flow);
    return names;
}

void check_export_name(const fs::path& file) {
    const std::string suffix = lower_suffix(without_last_slash(file));
    if (suffix.empty() || fs::is_directory(file) || writers().contains(suffix)) return;
    std::vector<std::string> suffixes;
    for (const auto& [known, writer] : writers()) suffixes.push_back(known);
    throw UsageError("'" + file.filename().string() + "': there is no format for '" + suffix + "'" +
                     did_you_mean(suffix, suffixes) + " (there are " + joined(suffixes) +
                     ", and a folder for an OpenFOAM case)");
}

void export_scene(PendingFiles& files, const fs::path& file, const Scene& scene,
                  const CfdParameters& flow) {
    check_export_name(file);
    const fs::path name = without_last_slash(file);
    const auto writer = writers().find(lower_suffix(name));
    if (writer == writers().end() || fs::is_directory(file))
        write_as_openfoam(files, name, scene, flow);
    else
        writer->second(files, name, scene);
}

}  // namespace vesselbench
