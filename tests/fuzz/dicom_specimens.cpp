#include "tests/fuzz/dicom_specimens.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gdcmAttribute.h>
#include <gdcmImage.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gdcmMediaStorage.h>
#include <gdcmUIDGenerator.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

namespace vesselbench::fuzz {

namespace {

namespace fs = std::filesystem;

template <std::uint16_t Group, std::uint16_t Element>
void set_text(gdcm::DataSet& set, const char* text) {
    gdcm::Attribute<Group, Element> attribute;
    attribute.SetValue(text);
    set.Replace(attribute.GetAsDataElement());
}

/// 4 x 4 pixels in 16 bits; several frames make it a volume of its own.
void write_dicom(const fs::path& path, double z, unsigned frames = 1) {
    gdcm::ImageWriter writer;
    gdcm::Image& image = writer.GetImage();
    image.SetNumberOfDimensions(frames > 1 ? 3 : 2);
    image.SetDimension(0, 4);
    image.SetDimension(1, 4);
    if (frames > 1) image.SetDimension(2, frames);
    image.SetPixelFormat(gdcm::PixelFormat::INT16);
    image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image.SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    for (unsigned a = 0; a < (frames > 1 ? 3U : 2U); ++a) image.SetSpacing(a, 0.5);
    for (unsigned a = 0; a < 3; ++a) image.SetOrigin(a, a == 2 ? z : 1.5);
    const double cosines[6] = {1, 0, 0, 0, 1, 0};
    image.SetDirectionCosines(cosines);
    image.SetSlope(2.0);
    image.SetIntercept(-1000.0);
    std::vector<short> pixels;
    for (unsigned p = 0; p < 16 * frames; ++p) pixels.push_back(static_cast<short>(p));
    gdcm::DataElement data(gdcm::Tag(0x7fe0, 0x0010));
    data.SetByteValue(reinterpret_cast<const char*>(pixels.data()),
                      static_cast<std::uint32_t>(pixels.size() * sizeof(short)));
    image.SetDataElement(data);
    gdcm::DataSet& set = writer.GetFile().GetDataSet();
    const auto storage = frames > 1 ? gdcm::MediaStorage::EnhancedCTImageStorage
                                    : gdcm::MediaStorage::CTImageStorage;
    set_text<0x0008, 0x0016>(set, gdcm::MediaStorage::GetMSString(storage));
    set_text<0x0008, 0x0018>(set, ("1.2.3." + std::to_string(static_cast<int>(z))).c_str());
    set_text<0x0020, 0x000e>(set, "1.2.3.4");
    set_text<0x0028, 0x0004>(set, "MONOCHROME2");
    writer.SetFileName(path.c_str());
    if (!writer.Write()) throw std::runtime_error("a DICOM specimen cannot be written");
}

/// The same slice in another transfer syntax; none if this GDCM cannot encode it.
void transcode(const fs::path& from, const fs::path& to, gdcm::TransferSyntax::TSType syntax) {
    gdcm::ImageReader reader;
    reader.SetFileName(from.c_str());
    if (!reader.Read()) throw std::runtime_error("a DICOM specimen cannot be read");
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(syntax);
    change.SetInput(reader.GetImage());
    if (!change.Change()) return;
    gdcm::ImageWriter writer;
    writer.SetFile(reader.GetFile());
    writer.SetImage(change.GetOutput());
    writer.SetFileName(to.c_str());
    (void)writer.Write();
}

}  // namespace

void write_dicom_specimens(const fs::path& folder) {
    const fs::path single = folder / "dcm", series = folder / "dicom-folder";
    for (const fs::path& made : {single, series}) fs::create_directories(made / "beside");
    write_dicom(series / "slice.dcm", 2.0);
    write_dicom(series / "beside" / "first.dcm", 0.0);
    write_dicom(series / "beside" / "second.dcm", 1.0);
    write_dicom(single / "frames.dcm", 0.0, 3);
    using Syntax = gdcm::TransferSyntax;
    transcode(series / "slice.dcm", series / "rle.dcm", Syntax::RLELossless);
    transcode(series / "slice.dcm", series / "jpeg.dcm", Syntax::JPEGLosslessProcess14_1);
    transcode(series / "slice.dcm", series / "jpegls.dcm", Syntax::JPEGLSLossless);
    transcode(series / "slice.dcm", series / "implicit.dcm", Syntax::ImplicitVRLittleEndian);
    transcode(single / "frames.dcm", single / "frames-rle.dcm", Syntax::RLELossless);
}

void write_vti_specimens(const Image& image, const std::string& folder) {
    vtkNew<vtkImageData> grid;
    grid->SetDimensions(image.size[0], image.size[1], image.size[2]);
    grid->SetSpacing(0.5, 0.5, 1.0);
    grid->AllocateScalars(VTK_SHORT, 1);
    auto* values = static_cast<short*>(grid->GetScalarPointer());
    for (std::size_t v = 0; v < image.voxel_count(); ++v)
        values[v] = static_cast<short>((*image.voxels)[v]);
    const auto write = [&](const std::string& name, int mode, bool compressed) {
        vtkNew<vtkXMLImageDataWriter> writer;
        writer->SetInputData(grid);
        writer->SetDataMode(mode);
        if (!compressed) writer->SetCompressorTypeToNone();
        writer->SetFileName((folder + name).c_str());
        writer->Write();
    };
    write("text.vti", vtkXMLWriter::Ascii, false);
    write("binary.vti", vtkXMLWriter::Binary, true);
    write("appended.vti", vtkXMLWriter::Appended, true);
    write("plain.vti", vtkXMLWriter::Appended, false);
}

}  // namespace vesselbench::fuzz
