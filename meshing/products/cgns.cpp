#include "meshing/products/cgns.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <utility>

#include <cgnslib.h>
#include <dlfcn.h>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

constexpr double kMetres = 1e-3;
constexpr std::size_t kLongestName = 32;

/// Exponents of mass, length, time, temperature and angle.
constexpr float kLength[] = {0, 1, 0, 0, 0};

constexpr const char* kLibrary = "libcgns.so.3.4";

/// Null if it is not installed. The system opens it once, however often it is asked for.
void* library() {
    return dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
}

/// A function of the CGNS library, which is loaded where a file is written: it brings some thirty
/// others, among them HDF5 and what reads files over a network.
template <class Function>
Function* loaded(const char* name) {
    void* const opened = library();
    if (opened == nullptr)
        throw IoError("CGNS: its library is missing here: install the package libcgns3.4");
    void* const found = dlsym(opened, name);
    if (found == nullptr)
        throw IoError(std::string("CGNS: ") + kLibrary + " lacks " + name +
                      ": install the package libcgns3.4 again");
    return reinterpret_cast<Function*>(found);
}

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): a function's type and its name
#define LOADED(function) (*loaded<decltype(function)>(#function))

/// A file that is being written: its one base and zone have the number 1.
class CgnsFile {
public:
    /// \param target what the file at `path` will be: errors name it
    CgnsFile(const std::string& path, std::string target) : target_(std::move(target)) {
        check(LOADED(cg_set_file_type)(CG_FILE_HDF5));
        check(LOADED(cg_open)(path.c_str(), CG_MODE_WRITE, &number_));
    }

    ~CgnsFile() {
        if (open_) close_(number_);
    }

    CgnsFile(const CgnsFile&) = delete;
    CgnsFile& operator=(const CgnsFile&) = delete;

    /// Whatever a buffer held back may fail here.
    void close() {
        open_ = false;
        check(close_(number_));
    }

    void add_base(const std::string& provenance) {
        int base = 0;
        check(LOADED(cg_base_write)(number_, "vesselbench", 3, 3, &base));
        check(LOADED(cg_goto)(number_, 1, "end"));
        check(LOADED(cg_dataclass_write)(CGNS_ENUMV(Dimensional)));
        check(LOADED(cg_units_write)(CGNS_ENUMV(Kilogram), CGNS_ENUMV(Meter), CGNS_ENUMV(Second),
                                     CGNS_ENUMV(Kelvin), CGNS_ENUMV(Radian)));
        if (!provenance.empty())
            check(LOADED(cg_descriptor_write)("Provenance", comment_line(provenance).c_str()));
    }

    void add_zone(const VolumeMesh& mesh) {
        const cgsize_t sizes[] = {static_cast<cgsize_t>(mesh.points.size()),
                                  static_cast<cgsize_t>(mesh.cell_count()), 0};
        int zone = 0;
        check(LOADED(cg_zone_write)(number_, 1, "lumen", sizes, CGNS_ENUMV(Unstructured), &zone));
        const char* const names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
        std::vector<double> lengths(mesh.points.size());
        for (int axis = 0; axis < 3; ++axis) {
            std::ranges::transform(mesh.points, lengths.begin(),
                                   [&](const Vec3& p) { return p[axis] * kMetres; });
            int coordinate = 0;
            check(LOADED(cg_coord_write)(number_, 1, 1, CGNS_ENUMV(RealDouble), names[axis],
                                         lengths.data(), &coordinate));
            check(LOADED(cg_goto)(number_, 1, "Zone_t", 1, "GridCoordinates_t", 1, "DataArray_t",
                                  coordinate, "end"));
            check(LOADED(cg_exponents_write)(CGNS_ENUMV(RealSingle), kLength));
        }
    }

    /// Elements of one shape follow those that were added.
    template <class Corners>
    void add_elements(const std::string& name, CGNS_ENUMT(ElementType_t) shape,
                      const std::vector<Corners>& elements) {
        if (elements.empty()) return;
        std::vector<cgsize_t> corners;
        corners.reserve(elements.size() * Corners{}.size());
        for (const Corners& element : elements)
            for (const VertexId v : element) corners.push_back(static_cast<cgsize_t>(v) + 1);
        const cgsize_t last = elements_ + static_cast<cgsize_t>(elements.size());
        int section = 0;
        check(LOADED(cg_section_write)(number_, 1, 1, name.c_str(), shape, elements_ + 1, last, 0,
                                       corners.data(), &section));
        elements_ = last;
    }

    /// A boundary condition, and a family of its name, for the elements after the `first` ones.
    void add_patch(const std::string& name, CGNS_ENUMT(BCType_t) kind, cgsize_t first) {
        int family = 0, condition = 0;
        check(LOADED(cg_family_write)(number_, 1, name.c_str(), &family));
        check(LOADED(cg_fambc_write)(number_, 1, family, "FamBC", kind, &condition));
        const cgsize_t range[] = {first + 1, elements_};
        check(LOADED(cg_boco_write)(number_, 1, 1, name.c_str(), CGNS_ENUMV(FamilySpecified),
                                    CGNS_ENUMV(PointRange), 2, range, &condition));
        check(LOADED(cg_boco_gridlocation_write)(number_, 1, 1, condition, CGNS_ENUMV(FaceCenter)));
        check(LOADED(cg_goto)(number_, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", condition, "end"));
        check(LOADED(cg_famname_write)(name.c_str()));
    }

    [[nodiscard]] cgsize_t elements() const { return elements_; }

private:
    void check(int error) const {
        if (error != CG_OK)
            throw IoError("'" + bare_name(target_) +
                          "' cannot be written as CGNS: " + LOADED(cg_get_error)());
    }

    decltype(cg_close)* close_ = loaded<decltype(cg_close)>("cg_close");
    std::string target_;
    int number_ = 0;
    bool open_ = true;
    cgsize_t elements_ = 0;  // added so far
};

/// Names of at most 32 characters that differ from each other and from those of the other nodes
/// beside them, and that HDF5 does not take for a path.
class ShortNames {
public:
    std::string add(std::string name) {
        if (name == "." || name == "..") name.assign(name.size(), '_');
        std::string made = name.substr(0, kLongestName);
        for (int number = 2; !taken_.insert(made).second; ++number) {
            const std::string end = "_" + std::to_string(number);
            made = name.substr(0, kLongestName - end.size()) + end;
        }
        return made;
    }

private:
    std::set<std::string> taken_ = {"lumen",    "Provenance",      "DataClass", "DimensionalUnits",
                                    "ZoneType", "GridCoordinates", "ZoneBC"};
};

CGNS_ENUMT(BCType_t) condition_for(PatchKind kind) {
    switch (kind) {
        case PatchKind::Inlet:
            return CGNS_ENUMV(BCInflow);
        case PatchKind::Outlet:
            return CGNS_ENUMV(BCOutflow);
        case PatchKind::Wall:
        case PatchKind::Cut:
            break;
    }
    return CGNS_ENUMV(BCWall);
}

template <class Corners>
std::vector<Corners> faces_of_patch(const std::vector<Corners>& faces, const PatchLabels& labels,
                                    std::size_t patch) {
    std::vector<Corners> own;
    for (std::size_t f = 0; f < faces.size(); ++f)
        if (labels[f] == patch) own.push_back(faces[f]);
    return own;
}

/// PENTA_6 (SIDS, 3.3): seen from nodes 4, 5, 6, the nodes 1, 2, 3 run counter-clockwise.
std::vector<Prism> inner_first(std::vector<Prism> prisms) {
    for (auto& [a, b, c, d, e, f] : prisms) {
        std::swap(a, d);
        std::swap(b, e);
        std::swap(c, f);
    }
    return prisms;
}

void add_patches(CgnsFile& file, const VolumeMesh& mesh, ShortNames& names,
                 const Progress& progress) {
    for (std::size_t k = 0; k < mesh.patches.size(); ++k) {
        progress.check_cancelled();
        const auto triangles = faces_of_patch(mesh.boundary, mesh.boundary_patches, k);
        const auto sides = faces_of_patch(mesh.boundary_sides, mesh.side_patches, k);
        if (triangles.empty() && sides.empty()) continue;
        const std::string name = names.add(mesh.patches[k].name);
        const cgsize_t first = file.elements();
        file.add_elements(name, CGNS_ENUMV(TRI_3), triangles);
        if (!sides.empty())
            file.add_elements(names.add(name + "_sides"), CGNS_ENUMV(QUAD_4), sides);
        file.add_patch(name, condition_for(mesh.patches[k].kind), first);
    }
}

}  // namespace

bool cgns_installed() {
    return library() != nullptr;
}

void write_cgns(const VolumeMesh& mesh, const std::string& path, const Progress& progress,
                const std::string& provenance) {
    if (mesh.tetrahedra.empty()) throw InvalidInput("CGNS: the volume mesh has no cells");
    require_plain_names(mesh.patches);
    static std::mutex one_writer;  // the library keeps its open files in global variables
    const std::lock_guard lock(one_writer);
    progress.report(0.0, writing_text(path));
    PendingFiles pending;
    CgnsFile file(pending.add(path).string(), path);
    file.add_base(provenance);
    file.add_zone(mesh);
    progress.report(0.3, writing_text(path));
    ShortNames names;
    file.add_elements(names.add("tetrahedra"), CGNS_ENUMV(TETRA_4), mesh.tetrahedra);
    file.add_elements(names.add("prisms"), CGNS_ENUMV(PENTA_6), inner_first(mesh.prisms));
    progress.report(0.7, writing_text(path));
    add_patches(file, mesh, names, progress);
    file.close();
    pending.commit();
}

}  // namespace vesselbench
