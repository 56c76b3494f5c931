#include "geometry/formats/dicom.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <system_error>

#include <gdcmAttribute.h>
#include <gdcmImage.h>
#include <gdcmImageReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/number_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// Tolerance of slice distances relative to their mean (rounded positions).
constexpr double kUneven = 0.05;

/// Geometry and pixels of one DICOM file; nothing else is kept.
struct Frames {
    std::string name;    ///< file name without its folder
    std::string series;  ///< only to distinguish series
    int columns = 0;
    int rows = 0;
    int count = 1;
    Vec3 along_row = Vec3::UnitX();     ///< patient direction of increasing column index
    Vec3 along_column = Vec3::UnitY();  ///< patient direction of increasing row index
    double spacing_i = 1.0;             ///< [mm]
    double spacing_j = 1.0;             ///< [mm]
    std::vector<Vec3> positions;        ///< [mm] of each frame's first voxel, or empty
    double stated_distance = 0.0;       ///< [mm] between frames as stated in the header, or 0
    bool frames_are_times = false;
    std::vector<float> voxels;

    [[nodiscard]] Vec3 normal() const { return along_row.cross(along_column); }
};

const gdcm::DataElement* element(const gdcm::DataSet& set, std::uint16_t group,
                                 std::uint16_t number) {
    const gdcm::Tag tag(group, number);
    return set.FindDataElement(tag) && !set.GetDataElement(tag).IsEmpty() ? &set.GetDataElement(tag)
                                                                          : nullptr;
}

std::string text_of(const gdcm::DataElement* found) {
    const gdcm::ByteValue* value = found ? found->GetByteValue() : nullptr;
    if (!value) return {};
    std::string text(value->GetPointer(), value->GetLength());
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

/// Numbers of a decimal string "a\b\c"; empty unless there are `count`.
std::vector<double> decimals(const gdcm::DataElement* found, std::size_t count) {
    std::string text = text_of(found);
    std::replace(text.begin(), text.end(), '\\', ' ');
    std::vector<double> values;
    for (const auto& word : words_of(text))
        if (const auto number = number_in(word)) values.push_back(*number);
    if (values.size() != count) values.clear();
    return values;
}

/// The data set of the first item of a sequence in `set`, or nothing.
std::optional<gdcm::DataSet> first_item(const gdcm::DataSet& set, std::uint16_t group,
                                        std::uint16_t number) {
    const gdcm::DataElement* found = element(set, group, number);
    const auto items = found ? found->GetValueAsSQ() : nullptr;
    if (!items || items->GetNumberOfItems() == 0) return std::nullopt;
    return items->GetItem(1).GetNestedDataSet();
}

/// Position of a data set's frame: of the slice, or of an enhanced file's functional group.
std::optional<Vec3> position_in(const gdcm::DataSet& set) {
    auto values = decimals(element(set, 0x0020, 0x0032), 3);
    if (values.empty())
        if (const auto plane = first_item(set, 0x0020, 0x9113))
            values = decimals(element(*plane, 0x0020, 0x0032), 3);
    if (values.empty()) return std::nullopt;
    return Vec3(values[0], values[1], values[2]);
}

std::vector<Vec3> positions_in(const gdcm::DataSet& set, int count) {
    std::vector<Vec3> positions;
    if (count == 1) {
        if (const auto position = position_in(set)) positions.push_back(*position);
        return positions;
    }
    const gdcm::DataElement* groups = element(set, 0x5200, 0x9230);
    const auto items = groups ? groups->GetValueAsSQ() : nullptr;
    if (!items || items->GetNumberOfItems() != static_cast<std::size_t>(count)) return {};
    for (std::size_t i = 1; i <= items->GetNumberOfItems(); ++i)
        if (const auto position = position_in(items->GetItem(i).GetNestedDataSet()))
            positions.push_back(*position);
    if (positions.size() != static_cast<std::size_t>(count)) positions.clear();
    return positions;
}

/// True if the frame increment pointer names a time (frame time, frame time vector).
bool frames_in_time(const gdcm::DataSet& set) {
    const gdcm::DataElement* pointer = element(set, 0x0028, 0x0009);
    if (!pointer) return false;
    gdcm::Attribute<0x0028, 0x0009> attribute;
    attribute.SetFromDataElement(*pointer);
    const gdcm::Tag tag = attribute.GetNumberOfValues() > 0 ? attribute.GetValue(0) : gdcm::Tag();
    return tag == gdcm::Tag(0x0018, 0x1063) || tag == gdcm::Tag(0x0018, 0x1065);
}

template <class T>
std::vector<float> scaled(const std::vector<char>& raw, std::size_t count, double slope,
                          double intercept) {
    std::vector<float> voxels(count);
    const auto* values = reinterpret_cast<const T*>(raw.data());
    for (std::size_t i = 0; i < count; ++i)
        voxels[i] = static_cast<float>(slope * static_cast<double>(values[i]) + intercept);
    return voxels;
}

/// \throw InvalidInput if the file cannot hold the pixels that its header announces
void check_announced(const gdcm::Image& image, std::uintmax_t file_size, const std::string& name) {
    constexpr std::uintmax_t kLargestRatio = 1000;  // of the compressions in use
    const gdcm::TransferSyntax& syntax = image.GetTransferSyntax();
    const bool compressed =
        syntax.IsEncapsulated() || syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
    if (image.GetBufferLength() / (compressed ? kLargestRatio : 1) > file_size)
        bad_file(name,
                 "its header announces " + std::to_string(image.GetBufferLength()) +
                     " bytes of pixels, which cannot be in " + std::to_string(file_size) + " bytes",
                 "the file is truncated or damaged: copy it again");
}

std::vector<float> pixels_of(const gdcm::Image& image, std::size_t count, const std::string& name) {
    std::vector<char> raw(image.GetBufferLength());
    const gdcm::PixelFormat& format = image.GetPixelFormat();
    if (format.GetSamplesPerPixel() != 1)
        bad_file(name, "it has colour pixels", "export the original slices");
    if (raw.size() < count * format.GetPixelSize() || !image.GetBuffer(raw.data()))
        bad_file(name,
                 std::string("its pixels cannot be decoded (transfer syntax ") +
                     image.GetTransferSyntax().GetString() + ", or the file is truncated)",
                 "copy it again, or export it without compression");
    const double slope = image.GetSlope(), intercept = image.GetIntercept();
    switch (format.GetScalarType()) {
        case gdcm::PixelFormat::UINT8:
            return scaled<std::uint8_t>(raw, count, slope, intercept);
        case gdcm::PixelFormat::INT8:
            return scaled<std::int8_t>(raw, count, slope, intercept);
        case gdcm::PixelFormat::UINT12:
        case gdcm::PixelFormat::UINT16:
            return scaled<std::uint16_t>(raw, count, slope, intercept);
        case gdcm::PixelFormat::INT12:
        case gdcm::PixelFormat::INT16:
            return scaled<std::int16_t>(raw, count, slope, intercept);
        case gdcm::PixelFormat::UINT32:
            return scaled<std::uint32_t>(raw, count, slope, intercept);
        case gdcm::PixelFormat::INT32:
            return scaled<std::int32_t>(raw, count, slope, intercept);
        case gdcm::PixelFormat::FLOAT32:
            return scaled<float>(raw, count, slope, intercept);
        case gdcm::PixelFormat::FLOAT64:
            return scaled<double>(raw, count, slope, intercept);
        default:
            bad_file(name, "its pixel format is not supported", "export it with 16 bits per pixel");
    }
}

/// Captures GDCM's messages during its lifetime: only a warning reveals a truncated file.
class GdcmMessages {
public:
    GdcmMessages() {
        gdcm::Trace::DebugOff();
        gdcm::Trace::ErrorOff();
        gdcm::Trace::SetWarningStream(text_);
        gdcm::Trace::WarningOn();
    }

    ~GdcmMessages() {
        gdcm::Trace::WarningOff();
        gdcm::Trace::SetWarningStream(std::cerr);
    }

    GdcmMessages(const GdcmMessages&) = delete;
    GdcmMessages& operator=(const GdcmMessages&) = delete;

    [[nodiscard]] bool tell_of_truncation() const {
        return text_.str().find("Incomplete Pixel Data") != std::string::npos;
    }

private:
    std::ostringstream text_;
};

Frames frames_of(const gdcm::ImageReader& reader, const std::string& name) {
    const gdcm::Image& image = reader.GetImage();
    const gdcm::DataSet& set = reader.GetFile().GetDataSet();
    Frames frames;
    frames.name = name;
    frames.series = text_of(element(set, 0x0020, 0x000e));
    frames.columns = static_cast<int>(image.GetDimension(0));
    frames.rows = static_cast<int>(image.GetDimension(1));
    frames.count = image.GetNumberOfDimensions() > 2 ? static_cast<int>(image.GetDimension(2)) : 1;
    const double* cosines = image.GetDirectionCosines();
    frames.along_row = Vec3(cosines[0], cosines[1], cosines[2]).normalized();
    frames.along_column = Vec3(cosines[3], cosines[4], cosines[5]).normalized();
    frames.spacing_i = image.GetSpacing(0);
    frames.spacing_j = image.GetSpacing(1);
    frames.positions = positions_in(set, frames.count);
    for (const std::uint16_t number : {0x0088, 0x0050})  // between slices, else slice thickness
        if (const auto stated = decimals(element(set, 0x0018, number), 1);
            frames.stated_distance <= 0.0 && !stated.empty())
            frames.stated_distance = std::abs(stated[0]);
    frames.frames_are_times = frames.count > 1 && frames_in_time(set);
    const std::size_t count =
        checked_voxel_count({frames.columns, frames.rows, frames.count}, name);
    frames.voxels = pixels_of(image, count, name);
    return frames;
}

/// Segmentations are no images of intensities: they state regions in their own ways.
/// \throw InvalidInput if the file is one
void refuse_segmentation(const gdcm::DataSet& set, const std::string& name) {
    const std::string kind = text_of(element(set, 0x0008, 0x0016));  // SOP class
    const bool contours = kind == "1.2.840.10008.5.1.4.1.1.481.3";
    if (!contours && kind != "1.2.840.10008.5.1.4.1.1.66.4" &&
        kind != "1.2.840.10008.5.1.4.1.1.66.5")
        return;
    const std::string module = contours ? "SlicerRT" : "QuantitativeReporting";
    bad_file(
        name,
        std::string("it is a DICOM segmentation (") +
            (contours ? "RTSTRUCT, contours of a treatment plan" : "SEG") + "), which is not read",
        "load it with its image in 3D Slicer (extension " + module +
            "), and export it by Segmentations, Export to files, as labelmap in NRRD or NIfTI, "
            "or save it as .seg.nrrd: give that file as INPUT, or as --mask of the image");
}

Frames read_frames(const std::string& path) {
    const GdcmMessages messages;
    const std::string name = bare_name(path);
    gdcm::ImageReader reader;
    reader.SetFileName(path.c_str());
    const bool is_read = reader.Read();
    refuse_segmentation(reader.GetFile().GetDataSet(), name);
    if (!is_read)
        bad_file(name, "it is not a readable DICOM image (damaged, truncated, or without pixels)",
                 "copy or export it again");
    if (messages.tell_of_truncation())
        bad_file(name, "its pixel data is truncated", "the file is truncated: copy it again");
    check_announced(reader.GetImage(), fs::file_size(path), name);
    return frames_of(reader, name);
}

/// One slice in space: its position and its pixels.
struct Slice {
    Vec3 position;
    double along = 0.0;  ///< [mm] along the normal
    const Frames* frames = nullptr;
    int frame = 0;
};

std::string millimetres(double value) {
    return number_text(std::round(value * 1000.0) / 1000.0) + " mm";
}

void check_alike(const Frames& first, const Frames& other, const std::string& name) {
    constexpr double kParallel = 1e-4;
    if (other.columns != first.columns || other.rows != first.rows)
        bad_file(name,
                 "its slices differ in size: " + std::to_string(first.columns) + " x " +
                     std::to_string(first.rows) + " and " + std::to_string(other.columns) + " x " +
                     std::to_string(other.rows) + " (" + other.name + ")",
                 "put one series alone into a folder");
    if ((other.along_row - first.along_row).norm() > kParallel ||
        (other.along_column - first.along_column).norm() > kParallel ||
        std::abs(other.spacing_i - first.spacing_i) > kParallel * first.spacing_i ||
        std::abs(other.spacing_j - first.spacing_j) > kParallel * first.spacing_j)
        bad_file(name, "its slices differ in orientation or pixel size (" + other.name + ")",
                 "put one series alone into a folder");
}

/// Distances between neighbours must be equal: one step vector serves all slices.
Vec3 checked_step(const std::vector<Slice>& slices, const std::string& name) {
    std::vector<double> gaps;
    for (std::size_t s = 1; s < slices.size(); ++s)
        gaps.push_back(slices[s].along - slices[s - 1].along);
    std::vector<double> sorted = gaps;
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[sorted.size() / 2];
    constexpr double kSamePlace = 1e-3;  // [mm]
    const auto place = [&](std::size_t s) {
        return "at " + millimetres(slices[s].along) + " along the slice normal";
    };
    for (std::size_t s = 0; s < gaps.size(); ++s)
        if (gaps[s] < kSamePlace)
            bad_file(name, "two slices are in the same place, " + place(s),
                     "put one series (one time step) alone into a folder");
    for (std::size_t s = 0; s < gaps.size(); ++s)
        if (gaps[s] > (1.0 + kUneven) * median || gaps[s] < (1.0 - kUneven) * median)
            bad_file(name,
                     "its slices are not evenly spaced: " + millimetres(gaps[s]) + " " + place(s) +
                         ", but " + millimetres(median) + " elsewhere (is a slice missing?)",
                     "complete the series, or export it resampled to evenly spaced slices");
    const Vec3 step =
        (slices.back().position - slices.front().position) / static_cast<double>(slices.size() - 1);
    for (std::size_t s = 0; s < slices.size(); ++s) {
        const Vec3 expected = slices.front().position + static_cast<double>(s) * step;
        if ((slices[s].position - expected).norm() > kUneven * step.norm())
            bad_file(name, "its slices are not in a row", "export the series with one orientation");
    }
    return step;
}

ImageFile stacked(std::vector<Slice> slices, const std::string& name) {
    std::stable_sort(slices.begin(), slices.end(),
                     [](const Slice& a, const Slice& b) { return a.along < b.along; });
    const Frames& first = *slices.front().frames;
    const Vec3 step = checked_step(slices, name);
    const std::size_t area =
        static_cast<std::size_t>(first.columns) * static_cast<std::size_t>(first.rows);
    ImageHeader header;
    header.size = {first.columns, first.rows, static_cast<int>(slices.size())};
    (void)checked_voxel_count({header.size[0], header.size[1], header.size[2]}, name);
    header.index_to_patient.block<3, 1>(0, 0) = first.along_row * first.spacing_i;
    header.index_to_patient.block<3, 1>(0, 1) = first.along_column * first.spacing_j;
    header.index_to_patient.block<3, 1>(0, 2) = step;
    header.index_to_patient.block<3, 1>(0, 3) = slices.front().position;
    std::vector<float> voxels;
    voxels.reserve(area * slices.size());
    for (const Slice& slice : slices) {
        const auto begin =
            slice.frames->voxels.begin() +
            static_cast<std::ptrdiff_t>(area * static_cast<std::size_t>(slice.frame));
        voxels.insert(voxels.end(), begin, begin + static_cast<std::ptrdiff_t>(area));
    }
    ImageFile file;
    file.format = "DICOM";
    file.unit = 1.0;
    file.image = image_from(header, std::move(voxels), name);
    return file;
}

/// Frames without positions: evenly along the normal, at the distance stated in the header.
ImageFile stacked_by_header(const Frames& frames) {
    if (frames.stated_distance <= 0.0)
        bad_file(frames.name, "its frames state neither positions nor a distance",
                 "export it as a series of slices");
    std::vector<Slice> slices;
    for (int f = 0; f < frames.count; ++f) {
        const double along = f * frames.stated_distance;
        slices.push_back({along * frames.normal(), along, &frames, f});
    }
    ImageFile file = stacked(std::move(slices), frames.name);
    file.notes.push_back("the frames state no positions: they are used in file order, " +
                         millimetres(frames.stated_distance) + " apart");
    return file;
}

/// \throw InvalidInput if one is a link that leads out of the folder
std::vector<std::string> files_in(const std::string& folder) {
    std::error_code error;
    std::vector<std::string> files;
    fs::directory_iterator entries(folder, error);
    if (error)
        throw IoError(bare_name(folder) + ": the folder cannot be read (" + error.message() + ")");
    for (const auto& entry : entries)
        if (entry.is_regular_file(error))
            files.push_back(inner_file(folder, entry.path().filename(), "its file").string());
    std::sort(files.begin(), files.end());
    return files;
}

void check_one_series(const std::vector<Frames>& files, const std::string& name) {
    std::map<std::string, int> series;
    for (const Frames& file : files) ++series[file.series];
    if (series.size() < 2) return;
    std::string counts;
    for (const auto& [id, count] : series)
        counts += (counts.empty() ? "" : ", ") + std::to_string(count);
    bad_file(name,
             "the folder contains " + std::to_string(series.size()) + " DICOM series (of " +
                 counts + " files)",
             "put one series alone into a folder");
}

}  // namespace

bool is_dicom(std::string_view head) {
    return head.size() >= 132 && head.substr(128, 4) == "DICM";
}

const Format& dicom_format() {
    static const Format format = {.name = "DICOM",
                                  .kind = FormatKind::Image,
                                  .suffixes = {".dcm", ".ima"},
                                  .content = "several frames, or a folder of slices",
                                  .folder = "of DICOM slices",
                                  .sniff = is_dicom,
                                  .any_name = true};
    return format;
}

ImageFile read_dicom(const std::string& path) {
    return fs::is_directory(path) ? read_dicom_folder(path) : read_dicom_file(path);
}

ImageFile read_dicom_file(const std::string& path) {
    if (file_content(path).empty()) bad_file(bare_name(path), "it is empty", "copy it again");
    const Frames frames = read_frames(path);
    if (frames.count == 1)
        bad_file(frames.name, "it contains a single slice",
                 "give the folder that contains all slices of the series");
    if (frames.frames_are_times)
        bad_file(frames.name,
                 "its " + std::to_string(frames.count) +
                     " frames are points in time of one slice, not slices of a volume",
                 "export the volume at one point in time");
    if (frames.positions.empty()) return stacked_by_header(frames);
    std::vector<Slice> slices;
    for (int f = 0; f < frames.count; ++f) {
        const Vec3& position = frames.positions[static_cast<std::size_t>(f)];
        slices.push_back({position, position.dot(frames.normal()), &frames, f});
    }
    return stacked(std::move(slices), frames.name);
}

ImageFile read_dicom_folder(const std::string& folder) {
    const std::string name = bare_name(folder);
    const Format& row = dicom_format();
    std::vector<std::string> paths;
    for (const std::string& path : files_in(folder))
        if (content_fits(row, path))
            paths.push_back(path);
        else if (fs::path(path).extension() ==
                 row.suffixes[0])  // a slice left out would shift others
            bad_file(bare_name(path), "it is not a readable DICOM file (empty or damaged)",
                     "copy it again, or remove it");
    if (paths.empty())
        bad_file(name, "the folder contains no DICOM slices",
                 "give the folder that contains the slices");
    if (paths.size() == 1) return read_dicom_file(paths.front());
    std::vector<Frames> files;
    for (const std::string& path : paths) {
        if (bare_name(path) == "DICOMDIR") continue;
        files.push_back(read_frames(path));
    }
    check_one_series(files, name);
    std::vector<Slice> slices;
    for (const Frames& file : files) {
        check_alike(files.front(), file, name);
        if (file.count != 1)
            bad_file(name, file.name + " contains several frames, but is not the only file",
                     "give that file alone");
        if (file.positions.empty())
            bad_file(name, file.name + " does not state its position in space",
                     "export the series with its geometry");
        slices.push_back(
            {file.positions[0], file.positions[0].dot(files.front().normal()), &file, 0});
    }
    return stacked(std::move(slices), name);
}

}  // namespace vesselbench
