#include "geometry/formats/vtk_image.h"

#include <algorithm>

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkLogger.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/vtk_xml_check.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

/// Records VTK's complaints instead of printing them.
class ComplaintWindow : public vtkOutputWindow {
public:
    static ComplaintWindow* New();
    vtkTypeMacro(ComplaintWindow, vtkOutputWindow);

    void DisplayText(const char* /*text*/) override { complained = true; }

    bool complained = false;
};

vtkStandardNewMacro(ComplaintWindow);

/// VTK readers report damage by printing: during its lifetime, they print into this object.
class Complaints {
public:
    Complaints() {
        vtkOutputWindow::SetInstance(window_);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }

    ~Complaints() { vtkOutputWindow::SetInstance(before_); }

    Complaints(const Complaints&) = delete;
    Complaints& operator=(const Complaints&) = delete;

    [[nodiscard]] bool any() const { return window_->complained; }

private:
    vtkSmartPointer<vtkOutputWindow> before_ = vtkOutputWindow::GetInstance();
    vtkNew<ComplaintWindow> window_;
};

[[noreturn]] void damaged(const std::string& name) {
    bad_file(name, "it is truncated or damaged", "copy or download the file again");
}

/// VTK allocates according to the header, so the header is checked before VTK reads it.
void check_vti_header(std::string_view bytes, const std::string& name) {
    const std::vector<VtkXmlElement> elements = require_vtk_xml(bytes, name);
    const auto image = std::ranges::find_if(elements, [](const VtkXmlElement& element) {
        return element.parent == 0U && element.name == "ImageData";
    });
    if (image == elements.end())
        bad_file(name, "it is not a VTK image (type ImageData)", "export it as image data");
    const auto words = words_of(attribute(*image, "WholeExtent").value_or(""));
    if (words.size() != 6) damaged(name);
    std::array<long long, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto low = number_in(words[2 * i]), high = number_in(words[2 * i + 1]);
        if (!low || !high || !(std::abs(*low) < 1e9) || !(std::abs(*high) < 1e9)) damaged(name);
        size[i] = static_cast<long long>(*high) - static_cast<long long>(*low) + 1;
    }
    const std::size_t count = checked_voxel_count(size, name);
    const bool compressed = attribute(elements.front(), "compressor").has_value();
    constexpr std::size_t kLargestRatio = 8000;  // of LZMA, the best of VTK's compressors
    if (count / (compressed ? kLargestRatio : 1) > bytes.size()) damaged(name);
}

void check_legacy_header(std::string_view bytes, const std::string& name) {
    const std::string_view head = bytes.substr(0, 4096);
    if (!head.starts_with("# vtk") || head.find("STRUCTURED_POINTS") == std::string_view::npos)
        bad_file(name, "it is not a VTK image (structured points)", "export it as image data");
    const auto at = head.find("DIMENSIONS");
    if (at == std::string_view::npos) damaged(name);
    const auto words = words_of(head.substr(at, head.find('\n', at) - at));
    if (words.size() != 4) damaged(name);
    std::array<long long, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto n = number_in(words[i + 1]);
        if (!n || !(std::abs(*n) < 1e9)) damaged(name);
        size[i] = static_cast<long long>(*n);
    }
    const std::size_t count = checked_voxel_count(size, name);
    if (count > bytes.size()) damaged(name);  // a voxel has at least one byte
}

vtkDataArray* scalars_of(vtkImageData* data, const std::string& name) {
    vtkPointData* points = data->GetPointData();
    vtkDataArray* found = points->GetScalars();
    for (int a = 0; a < points->GetNumberOfArrays(); ++a)
        if (!found || found->GetNumberOfComponents() != 1) found = points->GetArray(a);
    if (!found || found->GetNumberOfComponents() != 1)
        bad_file(name, "it has no point array with one value per voxel",
                 "export scalars at the points");
    if (found->GetNumberOfTuples() != data->GetNumberOfPoints()) damaged(name);
    return found;
}

Image image_from_vtk(vtkImageData* data, const std::string& name) {
    ImageHeader header;
    data->GetDimensions(header.size.data());
    const auto [ni, nj, nk] = header.size;
    const std::size_t count = checked_voxel_count({ni, nj, nk}, name);
    vtkDataArray* scalars = scalars_of(data, name);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            header.index_to_patient(r, c) =
                data->GetDirectionMatrix()->GetElement(r, c) * data->GetSpacing()[c];
    const int* extent = data->GetExtent();
    const Vec3 first(extent[0], extent[2], extent[4]);
    header.index_to_patient.topRightCorner<3, 1>() =
        Vec3(data->GetOrigin()) + header.index_to_patient.topLeftCorner<3, 3>() * first;
    std::vector<float> voxels(count);
    for (std::size_t i = 0; i < count; ++i)
        voxels[i] = static_cast<float>(scalars->GetTuple1(static_cast<vtkIdType>(i)));
    return image_from(header, std::move(voxels), name);
}

template <class Reader>
Image read_with(const std::string& path, const std::string& name) {
    vtkNew<Reader> reader;
    const Complaints complaints;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (complaints.any() || !reader->GetOutput() || reader->GetOutput()->GetNumberOfPoints() == 0)
        damaged(name);
    return image_from_vtk(reader->GetOutput(), name);
}

ImageFile image_file(Image image) {
    ImageFile file;
    file.image = std::move(image);
    file.notes.emplace_back(
        "a VTK image does not state the direction of its axes: left, posterior, superior is "
        "assumed");
    return file;
}

}  // namespace

ImageFile read_vti(const std::string& path) {
    const std::string name = bare_name(path);
    check_vti_header(file_content(path), name);
    return image_file(read_with<vtkXMLImageDataReader>(path, name));
}

ImageFile read_legacy_vtk_image(const std::string& path) {
    const std::string name = bare_name(path);
    check_legacy_header(file_content(path), name);
    return image_file(read_with<vtkStructuredPointsReader>(path, name));
}

bool is_legacy_structured_points(std::string_view head) {
    return head.find("STRUCTURED_POINTS") != std::string_view::npos;
}

}  // namespace vesselbench
