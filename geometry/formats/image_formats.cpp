#include "geometry/formats/image_formats.h"

#include "geometry/formats/dicom.h"
#include "geometry/formats/meta_image.h"
#include "geometry/formats/nifti.h"
#include "geometry/formats/nrrd.h"
#include "geometry/formats/vtk_image.h"

namespace vesselbench {

const std::vector<ImageFormat>& image_formats() {
    using enum FormatKind;
    static const std::vector<ImageFormat> rows = {
        {{.name = "NIfTI", .kind = Image, .suffixes = {".nii"}, .content = "NIfTI-1"},
         read_nifti,
         write_nifti},
        {{.name = "NIfTI",
          .kind = Image,
          .suffixes = {".nii.gz"},
          .content = "NIfTI-1, compressed"},
         read_nifti,
         write_compressed_nifti},
        {{.name = "NRRD",
          .kind = Image,
          .suffixes = {".nrrd"},
          .content = "compressed",
          .also_read = {".nhdr"}},
         read_nrrd,
         write_nrrd},
        {{.name = "MetaImage",
          .kind = Image,
          .suffixes = {".mha"},
          .content = "compressed",
          .also_read = {".mhd"}},
         read_meta_image,
         write_meta_image},
        {{.name = "VTK", .kind = Image, .suffixes = {".vti"}, .content = "XML image data"},
         read_vti},
        {{.name = "VTK",
          .kind = Image,
          .suffixes = {".vtk"},
          .content = "legacy structured points",
          .sniff = is_legacy_structured_points},
         read_legacy_vtk_image},
        {dicom_format(), read_dicom}};
    return rows;
}

}  // namespace vesselbench
