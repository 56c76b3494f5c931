#include "geometry/formats/image_file.h"

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/image_formats.h"
#include "geometry/formats/label_table.h"
#include "geometry/formats/unreadable_file.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/regular_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

ImageFile read_format(const std::string& path) {
    if (!file_exists(path)) throw IoError(bare_name(path) + ": no such file");
    refuse_special_file(path);
    const ImageFormat* format = row_that_reads(image_formats(), path);
    if (!format)
        bad_file(bare_name(path), "its image format is unknown", "give " + image_formats_text());
    ImageFile file = format->read(path);
    file.format = format->name;
    return file;
}

ImageFile read_any(const std::string& path) {
    return read_or_explain([&] { return read_format(path); });
}

}  // namespace

std::string image_formats_text() {
    return enumerated(read_names(image_formats())) + " (" +
           enumerated(read_suffixes(image_formats())) + "), or " + folder_text(image_formats());
}

ImageFile read_image_file(const std::string& path) {
    ImageFile file = read_any(path);
    if (!file.layers.empty())
        bad_file(bare_name(path), "its segments overlap, in several layers",
                 "export one of them as a label map");
    return file;
}

ImageFile read_segmentation_file(const std::string& path) {
    ImageFile file = read_any(path);
    const bool unnamed = file.segments.empty() && has_label_table(path);
    if (unnamed && judge(file.image).kind == ImageKind::Labels)
        file.segments = label_table_beside(path, file.notes);
    return file;
}

Image read_image(const std::string& path) {
    return read_image_file(path).image;
}

void write_image(const std::string& path, const Image& image, const Progress& progress) {
    if (image.empty()) throw InvalidInput("there is no image to write");
    const ImageFormat* format = row_that_writes(image_formats(), path);
    if (!format)
        throw UsageError("'" + bare_name(path) + "': images are written as " +
                         enumerated(written_suffixes(image_formats()), "or"));
    format->write(image, path, progress);
}

}  // namespace vesselbench
