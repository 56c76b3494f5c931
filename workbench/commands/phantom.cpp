#include "geometry/phantoms/phantom.h"

#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/phantoms/phantom_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

// Names of the files in the folder; their suffixes choose the formats.
constexpr const char *kImage = "image.nii.gz", *kMask = "mask.nii.gz", *kExact = "exact.vtp",
                     *kNoisy = "noisy.vtp", *kNeighbour = "neighbour.vtp";

/// A case description, so that the folder can be used as an INPUT. It uses the mask only where an
/// expert had to separate vessels that blend in the image; elsewhere the intensities are more
/// accurate.
std::string case_text(const PhantomDescription& description) {
    Json json = {{"name", description.name}, {"image", kImage}, {"exact", kExact}};
    if (!description.imaging.kept_apart.empty()) json["mask"] = kMask;
    return text_from_json(json, 2) + "\n";
}

/// \throw IoError if the folder describes another case
void refuse_other_case(const std::filesystem::path& folder, const PhantomDescription& description) {
    const std::filesystem::path file = folder / "case.json";
    if (std::filesystem::exists(file) && file_content(file) != case_text(description))
        throw IoError("'" + folder.filename().string() +
                      "' holds another case: give another folder");
}

void print_json(const PhantomDescription& description, const Phantom& phantom,
                const std::string& folder) {
    Json files = {kImage, kMask, kExact, "case.json"};
    if (phantom.noisy) files.push_back(kNoisy);
    if (phantom.neighbour) files.push_back(kNeighbour);
    std::cout << text_from_json(Json({{"name", description.name},
                                      {"seed", description.seed},
                                      {"folder", folder},
                                      {"files", files}}),
                                2)
              << "\n";
}

}  // namespace

void write_phantom(const PhantomOptions& options, const Progress& progress) {
    PhantomDescription description = phantom_named(options.name);
    description.seed = options.seed.value_or(description.seed);
    const Phantom phantom = make_phantom(description, progress.part(0.0, 0.8));
    progress.report(0.8, "writing the phantom");
    const std::filesystem::path out = options.out;
    refuse_other_case(out, description);
    make_folder(out);
    PendingFiles files;
    const Progress cancel = progress.silent();
    write_image(files.add(out / kImage).string(), phantom.image, cancel);
    write_image(files.add(out / kMask).string(), phantom.mask, cancel);
    write_surface(phantom.exact, files.add(out / kExact).string(), cancel);
    if (phantom.noisy) write_surface(*phantom.noisy, files.add(out / kNoisy).string(), cancel);
    if (phantom.neighbour)
        write_surface(*phantom.neighbour, files.add(out / kNeighbour).string(), cancel);
    files.add_text(out / "case.json", case_text(description));
    progress.check_cancelled();
    files.commit();
    if (options.json) return print_json(description, phantom, options.out);
    std::cout << description.name << ": " << kImage << ", " << kMask
              << (phantom.neighbour ? std::string(", ") + kNeighbour : "") << " and " << kExact
              << " are in " << options.out << "\n'vesselbench prepare " << options.out
              << " --for cfd --out RESULT' accepts this folder as INPUT.\n";
}

}  // namespace vesselbench
