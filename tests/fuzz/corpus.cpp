#include "tests/fuzz/corpus.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numeric>

#include "geometry/formats/centerline_file.h"
#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "tests/fuzz/dicom_specimens.h"
#include "tests/fuzz/project_specimens.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "workbench/phantoms/builtin.h"
#include "workbench/prepare/builtin_recipes.h"
#include "workbench/project/serialization.h"
#include "workbench/project/stored_text.h"

namespace vesselbench::fuzz {

namespace {

namespace fs = std::filesystem;

/// Writes the files of one format.
class Shelf {
public:
    Shelf(const fs::path& folder, const std::string& format) : folder_(folder / format) {
        fs::create_directories(folder_ / "beside");
    }

    [[nodiscard]] std::string path(const std::string& name) const {
        return (folder_ / name).string();
    }

    void add(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }

    void add(const std::string& name, const Bytes& bytes) const {
        add(name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }

    void add_beside(const std::string& name, const std::string& bytes) const {
        add("beside/" + name, bytes);
    }

private:
    fs::path folder_;
};

Surface small_tube() {
    Surface tube = test::closed_tube(2.0, 8.0, 10, 4);
    std::vector<double> weights(tube.vertex_count());
    std::iota(weights.begin(), weights.end(), 0.25);
    tube.attributes["weight"] = std::make_shared<const std::vector<double>>(std::move(weights));
    return tube;
}

Image small_image() {
    Image image = test::ball_image(4.0, 8, Vec3(1.0, 1.5, 2.0));
    image.index_to_patient = test::oblique_matrix(Vec3(0.4, 0.9, 2.5), Vec3(-31.5, 12.25, 140.0));
    return image;
}

void write_surfaces(const fs::path& folder) {
    const Surface tube = small_tube();
    for (const std::string suffix : {"stl", "ply", "obj", "off", "vtp"})
        write_surface(tube, Shelf(folder, suffix).path("tube." + suffix));
    Shelf(folder, "stl")
        .add("text.stl",
             "solid wall\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
             "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid wall\n"
             "solid inlet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
             "vertex 0 1 0\nvertex 0 1 1.5e0\nendloop\nendfacet\nendsolid inlet\n");
    Shelf(folder, "ply")
        .add("text.ply",
             "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float "
             "y\n"
             "property float z\nproperty uchar red\nelement face 2\nproperty list uchar int "
             "vertex_indices\nproperty int label\nelement more 1\nproperty list short double y\n"
             "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n1 1 1 4\n3 0 1 2 0\n4 0 1 3 2 1\n2 1.5 2\n");
    Shelf(folder, "obj")
        .add("faces.obj",
             "# x\nmtllib a.mtl\ng wall\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 1 1 0\nvt "
             "0 0\nvn 0 0 1\nf 1/1/1 2//1 -2\ng inlet\nf 1 2 4 3\n");
    Shelf(folder, "off")
        .add("colours.off",
             "OFF\n# x\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 255 0 0\n4 0 1 "
             "3 2\n");
    Shelf(folder, "vtk")
        .add("text.vtk",
             "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 "
             "0\n0 1 "
             "0 1 1 0\nPOLYGONS 2 9\n3 0 1 2\n4 0 1 3 2\nCELL_DATA 2\nSCALARS ModelFaceID int 1\n"
             "LOOKUP_TABLE default\n1 2\nPOINT_DATA 4\nFIELD f 1\nweight 1 4 double\n0 1 2 3\n");
    Shelf(folder, "vtk")
        .add("image.vtk",
             "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
             "ORIGIN 0 0 0\nSPACING 1 1 2\nPOINT_DATA 8\nSCALARS v short 1\nLOOKUP_TABLE default\n"
             "1 2 3 4 5 6 7 8\n");
    const auto graph = centerlines_of(test::closed_tube(2.0, 24.0, 16, 24));
    write_centerlines(*graph, Shelf(folder, "centerlines").path("tube.vtp"));
}

/// What mended defects were found with.
void write_surface_reproductions(const fs::path& folder) {
    const std::string ply = "ply\nformat ascii 1.0\n";
    const Shelf plys(folder, "ply"), vtks(folder, "vtk"), vtps(folder, "vtp");
    plys.add("no-properties.ply", ply + "element x 999999999999999999\nend_header\n");
    plys.add("no-face-properties.ply", ply + "element face 999999999999\nend_header\n");
    const std::string vtk = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n";
    vtks.add("too-few.vtk", vtk + "POINTS 60 double\n0 0 0\n");
    vtks.add("short-field.vtk", vtk + "POINTS 1 double\n0 0 0\nFIELD f 1\nx 90 90 int\n");
    const std::string piece =
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" "
        "compressor=\"vtkZLibDataCompressor\">\n<PolyData><Piece NumberOfPoints=\"4\" "
        "NumberOfPolys=\"0\"><Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" "
        "format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>\n";
    std::string block;
    for (const std::uint32_t word : {1U, 0U, 0U, 40U})
        block.append(reinterpret_cast<const char*>(&word), sizeof word);
    vtps.add("no-data.vtp", piece + "</VTKFile>\n");
    vtps.add("block-of-nothing.vtp", piece + "<AppendedData encoding=\"raw\">\n_" + block +
                                         std::string(40, 'x') + "</AppendedData></VTKFile>\n");
    const std::string texts =
        "<FieldData><Array type='String' Name='n' NumberOfTuples='1' format='ascii'>97 0 98 0"
        "</Array></FieldData>";
    const std::string root = "<VTKFile type='PolyData' version='0.1'><PolyData>";
    vtps.add("entity.vtp", "<!DOCTYPE VTKFile [<!ENTITY e \"" + texts + "\">]>\n" + root +
                               "&e;</PolyData></VTKFile>\n");
    vtps.add("too-many-texts.vtp", root + texts + "</PolyData></VTKFile>\n");
}

void write_images(const fs::path& folder) {
    const Image image = small_image();
    for (const std::string suffix : {"nii", "nii.gz", "nrrd", "mha"})
        write_image(Shelf(folder, suffix).path("ball." + suffix), image);
    write_vti_specimens(image, Shelf(folder, "vti").path(""));
    const std::string head = "NRRD0004\n# x\ntype: unsigned char\ndimension: 3\n";
    const Shelf nrrds(folder, "nrrd"), detached(folder, "nhdr"), metas(folder, "mhd");
    nrrds.add("raw.nrrd", head +
                              "space: right-anterior-superior\nsizes: 2 3 2\nspace directions: "
                              "(0.5, 0, 0) (0,0.25,0) (0,0,-2)\nspace origin: (10,20,30)\n"
                              "encoding: raw\n\nabcdefghijkl");
    nrrds.add("text.nrrd", head + "sizes: 2 2 2\nencoding: ascii\n\n1 2 3 4\n5 6 7 8\n");
    nrrds.add("hex.nrrd", head + "sizes: 2 2 1\nencoding: hex\n\n01ff0a0B\n");
    nrrds.add("large.nrrd",
              head + "sizes: 1000 1000 900\nencoding: gzip\n\n" + std::string(300, '\x1f'));
    detached.add("d.nhdr",
                 "NRRD0004\ntype: short\ndimension: 3\nspace: LPS\nsizes: 2 2 1\nspacings: 1 2 3\n"
                 "endian: big\nencoding: raw\ndata file: d.raw\n");
    detached.add_beside("d.raw", std::string("\1\0\2\0\0\3\0\4", 8));
    metas.add("d.mhd",
              "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
              "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
              "ElementSpacing = 1 1 2\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
              "ElementDataFile = d.raw\n");
    metas.add_beside("d.raw", "abcdefgh");
    write_dicom_specimens(folder);
}

void write_json(const fs::path& folder) {
    const Shelf cases(folder, "case"), recipes(folder, "recipe"), phantoms(folder, "phantom");
    cases.add("phantom.json", R"({"name": "tube", "phantom": "tube", "seed": 7,
  "recipe": {"cfd": [{"operation": "repair"}], "rp": [{"operation": "smooth"}]}})");
    cases.add("surface.json", R"({"surface": "tube.stl", "units": "mm"})");
    cases.add("image.json", R"({"image": "a.nrrd", "mask": "b.nrrd", "recipe": {}})");
    cases.add_beside("tube.stl", "solid x\nendsolid x\n");
    for (const auto& [name, text] : builtin_recipe_texts()) recipes.add(name + ".json", text);
    recipes.add("arguments.json",
                R"([{"operation": "clip-opening", "arguments": {"tip": [1, 2, 3.5], "name": "a.b",
  "closed": [1, 2, 3]}, "otherwise": {"check": "none"}, "when": ["cfd", "no-mask"]},
  {"operation": "remesh", "step": "remeshing", "arguments": {"edge": 1e-3}, "optional": true}])");
    for (const auto& [name, text] : builtin_phantom_texts()) phantoms.add(name + ".json", text);
    const std::string deep(50000, '[');
    for (const Shelf& shelf : {cases, recipes, phantoms}) shelf.add("deep.json", deep);
}

Scene small_scene() {
    Scene scene;
    scene.surface = small_tube();
    scene.image = small_image();
    scene.neighbours["bone"] = test::cube(3.0);
    scene.sampling = sampling_of(*scene.image);
    VolumeMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    mesh.boundary = {{0, 2, 1}};
    mesh.boundary_patches = {0};
    mesh.patches = {{"wall", PatchKind::Wall}};
    scene.volume_mesh = std::make_shared<const VolumeMesh>(std::move(mesh));
    return scene;
}

void write_blobs(const fs::path& folder) {
    const Scene scene = small_scene();
    Shelf(folder, "scene").add("scene", encode_scene(scene));
    const Shelf parts(folder, "part");
    int number = 0;
    for (const ScenePart& part : take_apart(scene).parts) {
        const std::string name = std::to_string(number++);
        parts.add(name, encode(part, Compression::None));
        parts.add(name + "-zstd", encode(part, Compression::Zstd));
    }
    const Shelf texts(folder, "arguments");
    const Arguments arguments = {
        {"a", true},          {"b", std::int64_t{-7}},
        {"c", 0.1},           {"d", std::string("x y")},
        {"e", Vec3(1, 2, 3)}, {"f", std::vector<double>{1, 2.5, HUGE_VAL}}};
    texts.add("stored", stored_text(arguments));
    texts.add("packed", pack_text(stored_text(arguments) + std::string(400, ' ')));
}

std::vector<Specimen> files_in(const fs::path& folder) {
    std::vector<Specimen> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file())
            files.push_back({entry.path().filename().string(), file_content(entry.path())});
    std::ranges::sort(files, {}, &Specimen::name);
    return files;
}

}  // namespace

void write_corpus(const fs::path& folder) {
    write_surfaces(folder);
    write_surface_reproductions(folder);
    write_images(folder);
    write_json(folder);
    write_blobs(folder);
    fs::create_directories(folder / "project" / "beside");
    write_project_specimens(folder / "project");
}

Corpus read_corpus(const fs::path& folder) {
    Corpus corpus;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string format = entry.path().filename().string();
        corpus.specimens[format] = files_in(entry.path());
        corpus.companions[format] = files_in(entry.path() / "beside");
    }
    return corpus;
}

}  // namespace vesselbench::fuzz
