#include "geometry/formats/image_file.h"

#include <filesystem>
#include <fstream>

#include "geometry/formats/atomic_file.h"
#include "geometry/formats/dicom_file.h"
#include "geometry/formats/image_bytes.h"
#include "geometry/formats/meta_image_file.h"
#include "geometry/formats/nifti_file.h"
#include "geometry/formats/nrrd_file.h"
#include "geometry/formats/vtk_image_file.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

bool has_suffix(const std::string& path, std::initializer_list<const char*> suffixes) {
    const std::string name = lower_case(file_name(path));
    for (const char* suffix : suffixes)
        if (name.ends_with(suffix)) return true;
    return false;
}

/// A legacy .vtk file may hold a surface as well: its third line tells.
bool is_legacy_image(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::string head(1024, '\0');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.find("STRUCTURED_POINTS") != std::string::npos;
}

}  // namespace

ImageFile read_image_file(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return read_dicom_folder(path);
    if (!fs::exists(path, error)) throw IoError(file_name(path) + ": there is no such file");
    if (has_suffix(path, {".nii", ".nii.gz"})) return read_nifti(path);
    if (has_suffix(path, {".nrrd", ".nhdr"})) return read_nrrd(path);
    if (has_suffix(path, {".mha", ".mhd"})) return read_meta_image(path);
    if (has_suffix(path, {".vti", ".vtk"})) return read_vtk_image(path);
    if (has_suffix(path, {".dcm", ".ima"}) || is_dicom(path)) return read_dicom_file(path);
    bad_file(file_name(path), "it is of no known image format",
             "give NIfTI, NRRD, MetaImage, .vti, .vtk, or a folder of DICOM slices");
}

Image read_image(const std::string& path) {
    return read_image_file(path).image;
}

bool looks_like_image(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return !fs::exists(fs::path(path) / "case.json", error);
    if (has_suffix(path, {".vtk"})) return is_legacy_image(path);
    return has_suffix(path, {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd", ".vti", ".dcm",
                             ".ima"}) ||
           is_dicom(path);
}

void write_image(const std::string& path, const Image& image) {
    if (image.empty()) throw InvalidInput("there is no image to write");
    std::string bytes;
    if (has_suffix(path, {".nii.gz"}))
        bytes = deflated(nifti_bytes(image), true);
    else if (has_suffix(path, {".nii"}))
        bytes = nifti_bytes(image);
    else if (has_suffix(path, {".mha"}))
        bytes = meta_image_bytes(image);
    else if (has_suffix(path, {".nrrd"}))
        bytes = nrrd_bytes(image);
    else
        throw UsageError("'" + file_name(path) +
                         "': images are written as .nii, .nii.gz, .mha or .nrrd");
    write_file(path, [&](std::ostream& out) {
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    });
}

}  // namespace vesselbench
