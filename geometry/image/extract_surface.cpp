#include "geometry/image/extract_surface.h"

#include <algorithm>
#include <utility>

#include "geometry/image/clean_image.h"
#include "geometry/image/curved_field.h"
#include "geometry/image/drawn_wall.h"
#include "geometry/image/iso_surface.h"
#include "geometry/image/missing_voxels.h"
#include "geometry/image/resample.h"
#include "geometry/image/sampled_levels.h"
#include "geometry/image/separating_field.h"
#include "geometry/image/shells.h"
#include "geometry/image/voxel_band.h"
#include "geometry/image/voxel_chains.h"
#include "geometry/image/voxels.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/spread.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/wall_edges.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// A mask of 1 and 0: the surface midway between voxels keeps all staircases.
constexpr double kMaskIso = 0.5;

std::string text_of(double number) {
    return formatted(number, "%.6g");
}

void check(const Image& image, const std::optional<Image>& mask) {
    if (image.empty()) throw InvalidInput("the image is empty");
    const auto [least, most] = std::minmax_element(image.voxels->begin(), image.voxels->end());
    if (!(*most > *least))
        throw InvalidInput("the image is empty: all its voxels are " + text_of(*least));
    if (mask) require_same_place(image, *mask);
}

/// Intensities ready for extraction, and the parameters they were made with.
struct Intensities {
    bool inside_below = false;
    Cleaning cleaning;
    std::optional<double> resample;
    Image up;                        ///< turned so that the inside lies above
    Image ready;                     ///< cleaned and resampled
    std::optional<double> contrast;  ///< of the diffusion, if it ran
};

/// An image, and everything derived from it so far.
struct ImageSource {
    Image image;
    std::optional<Image> mask;
    ImageJudgement judgement;
    std::optional<double> bright;  ///< bright_threshold
    std::optional<Intensities> intensities;
};

/// The image and its mask.
bool uses_both(ExtractionMethod method) {
    return method == ExtractionMethod::Masked || method == ExtractionMethod::Wall;
}

bool wants_topology(const ExtractionParameters& parameters) {
    return parameters.with_topology && parameters.cleaning.any();
}

/// Fills in the method, the side and (for level sets) the threshold.
void decide_method(ImageSource& source, const ExtractionParameters& parameters, Extraction& result,
                   const Progress& progress) {
    const ImageJudgement& judgement = source.judgement;
    if (parameters.method) {
        result.method = *parameters.method;
    } else if (source.mask) {
        result.method = ExtractionMethod::Masked;
        result.reasons.emplace_back("there is a mask: intensities inside the dilated mask");
    } else if (!parameters.threshold && judgement.kind == ImageKind::Labels) {
        result.method = ExtractionMethod::Labels;
        result.reasons.push_back(judgement.reason);
    } else {
        result.method = ExtractionMethod::Threshold;
    }
    if (uses_both(result.method) && !source.mask)
        throw DiagnosedInput(
            {.code = "no-mask",
             .operation = "extract-surface",
             .remedies = {{.operation = "load-image", .arguments = {{"mask", ""}}}}});
    const bool level_set = result.method == ExtractionMethod::Threshold &&
                           judgement.kind == ImageKind::LevelSet &&
                           parameters.threshold.value_or(0.0) == 0.0;
    if (level_set && !(parameters.threshold && parameters.inside_below))
        result.reasons.push_back(judgement.reason);
    result.inside_below = parameters.inside_below.value_or(level_set && judgement.inside_below);
    if (parameters.threshold)
        result.threshold = *parameters.threshold;
    else if (result.method == ExtractionMethod::Threshold && !level_set) {
        if (!source.bright) source.bright = bright_threshold(source.image, progress);
        result.threshold = *source.bright;
        result.reasons.push_back(
            "threshold " + text_of(result.threshold) +
            ": midway between the medians of the voxels inside the wall and outside");
    }
}

Image cleaned_intensities(const Image& image, const Cleaning& cleaning,
                          std::optional<double>& contrast, const Progress& progress) {
    Image clean = image;
    if (cleaning.diffusion > 0) {
        contrast = cleaning.diffusion_contrast.value_or(edge_contrast(image));
        clean = diffuse(clean, {.iterations = cleaning.diffusion, .contrast = contrast}, progress);
    }
    progress.check_cancelled();
    clean = gaussian(clean, cleaning.gaussian);
    progress.check_cancelled();
    clean = opened(clean, cleaning.opening);
    progress.check_cancelled();
    return closed(clean, cleaning.closing);
}

/// Masks: opening and closing on the voxels.
Image cleaned_mask(const Image& mask, const Cleaning& cleaning) {
    return closed(opened(mask, cleaning.opening), cleaning.closing);
}

/// The image with its sign chosen so that the inside is above: opening then always thins the
/// vessel.
Image inside_up(const Image& image, bool inside_below) {
    if (!inside_below) return image;
    std::vector<float> voxels = *image.voxels;
    for (float& v : voxels) v = -v;
    Image result = image;
    result.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result;
}

/// A field whose inside is at or above `iso`.
struct Field {
    Image image;
    double iso = 0.0;
    std::optional<Image> of_mask = {};  ///< the same of the mask alone, if the image moved its wall
};

/// The mask with what its lumen needs (MaskSurface::Lumen).
Image lumen_mask(const Image& mask, const ExtractionParameters& parameters, Extraction& result,
                 const Progress& progress) {
    KeptLumen& kept = result.lumen.emplace();
    FreedMask freed = without_grazes(mask, parameters.freed_sides);
    kept.grazes = freed.grazes;
    Image whole = std::move(freed.mask);
    if (parameters.cleaning.closing == 0) {  // nobody said how far to close the mask
        const FilledMask filled = without_missing_voxels(whole);
        const auto before = std::ranges::count_if(*whole.voxels, is_inside);
        kept.closing = filled.closing;
        kept.loops = filled.before.tunnels() + filled.before.cavities;
        kept.filled =
            before > 0 ? static_cast<double>(filled.added) / static_cast<double>(before) : 0.0;
        whole = filled.mask;
    }
    progress.check_cancelled();
    JoinedMask joined = joined_chains(whole);
    kept.joined = joined.added;
    const std::vector<std::size_t> chain = chain_voxels(joined.mask);
    kept.chain = chain.size();
    if (!chain.empty()) {
        const auto [i, j, k] = index_of(whole, chain[chain.size() / 2]);
        kept.place = whole.to_patient(Vec3(i, j, k));
    }
    progress.check_cancelled();
    return std::move(joined.mask);
}

/// The function whose zero set is a mask's smooth surface, between slices as the parameters say.
Image smooth_field(const Image& mask, const ExtractionParameters& parameters, Extraction& result,
                   const Progress& progress) {
    if (parameters.between_slices == BetweenSlices::Curved && has_thick_slices(mask)) {
        if (auto curved = curved_field(mask, progress)) {
            result.between_slices = BetweenSlices::Curved;
            result.sampling = sampling_of(mask);  // the finer grid holds no more of the vessel
            return *std::move(curved);
        }
        result.reasons.emplace_back(
            "straight between the slices: a surface that is curved there "
            "would have other parts or handles than the mask");
    }
    return separating_field(mask, progress);
}

/// The voxels that are inside a field, as a mask.
Image sides_of_field(const Image& field) {
    std::vector<float> sides(field.voxel_count());
    for_each_vertex(sides.size(),
                    [&](std::size_t v) { sides[v] = (*field.voxels)[v] > 0.0f ? 1.0f : 0.0f; });
    return with_voxels(field, std::move(sides));
}

/// A field in which the chains of its mask keep their width. \param mask that it was made of
Image with_lumen_width(const Image& mask, const Image& field, const Extraction& result) {
    if (result.between_slices == BetweenSlices::Straight) return with_voxel_width(mask, field);
    return with_voxel_width(sides_of_field(field), field, chain_voxels_between(mask, field));
}

/// The chosen labels as a mask, cleaned and resampled.
Image chosen_mask(const Image& labels, const ExtractionParameters& parameters, Extraction& result,
                  const Progress& progress) {
    const auto there = labels_of(labels);
    for (const int label : parameters.labels)
        if (!std::binary_search(there.begin(), there.end(), label)) {
            std::string all;
            for (const int l : there) all += (all.empty() ? "" : ", ") + std::to_string(l);
            throw InvalidInput("the image has no label " + std::to_string(label) +
                               "; its labels are " + (all.empty() ? "none" : all));
        }
    result.labels = parameters.labels.empty() ? there : parameters.labels;
    const Cleaning& cleaning = parameters.cleaning;
    const Image mask = mask_of_labels(labels, parameters.labels);
    if (wants_topology(parameters)) result.before = voxel_topology(mask, kMaskIso);
    progress.check_cancelled();
    const Image clean = cleaned_mask(mask, cleaning);
    progress.check_cancelled();
    return parameters.resample ? resample_mask(clean, *parameters.resample) : clean;
}

Field label_field(const Image& labels, const ExtractionParameters& parameters, Extraction& result,
                  const Progress& progress) {
    Field field{chosen_mask(labels, parameters, result, progress), kMaskIso};
    progress.check_cancelled();
    result.mask_surface = parameters.mask_surface;
    if (parameters.mask_surface == MaskSurface::Smooth) {
        field = {smooth_field(field.image, parameters, result, progress), 0.0};
    } else if (parameters.mask_surface == MaskSurface::Lumen) {
        const Image mask = lumen_mask(field.image, parameters, result, progress);
        const Image smooth = smooth_field(mask, parameters, result, progress);
        field = {with_lumen_width(mask, smooth, result), 0.0};
    }
    field.image = gaussian(field.image, parameters.cleaning.gaussian);
    return field;
}

/// Cleaned and resampled, once for the same parameters.
const Intensities& prepared(ImageSource& source, const ExtractionParameters& parameters,
                            bool inside_below, const Progress& progress) {
    const auto& last = source.intensities;
    if (last && last->inside_below == inside_below && last->cleaning == parameters.cleaning &&
        last->resample == parameters.resample)
        return *last;
    Intensities made{.inside_below = inside_below,
                     .cleaning = parameters.cleaning,
                     .resample = parameters.resample,
                     .up = inside_up(source.image, inside_below)};
    made.ready = cleaned_intensities(made.up, made.cleaning, made.contrast, progress);
    progress.check_cancelled();
    if (made.resample) made.ready = resample_intensities(made.ready, *made.resample);
    return source.intensities.emplace(std::move(made));
}

Field threshold_field(ImageSource& source, const ExtractionParameters& parameters,
                      Extraction& result, const Progress& progress) {
    const double iso = result.inside_below ? -result.threshold : result.threshold;
    const Intensities& made = prepared(source, parameters, result.inside_below, progress);
    result.contrast = made.contrast;
    progress.check_cancelled();
    if (wants_topology(parameters)) result.before = voxel_topology(made.up, iso);
    return {made.ready, iso};
}

Field masked_field(ImageSource& source, const ExtractionParameters& parameters, Extraction& result,
                   const Progress& progress) {
    const Image inside = mask_of_labels(*source.mask, parameters.labels);
    result.labels = parameters.labels.empty() ? labels_of(*source.mask) : parameters.labels;
    progress.check_cancelled();
    if (!parameters.threshold) {
        result.threshold = masked_threshold(source.image, inside, progress);
        result.reasons.push_back(
            "threshold " + text_of(result.threshold) +
            ": midway between the medians of the voxels inside the wall and outside");
    }
    Field field = threshold_field(source, parameters, result, progress);
    progress.check_cancelled();
    Image grown = dilated(inside, parameters.dilation);
    progress.check_cancelled();
    if (result.before)
        result.before = voxel_topology(
            masked_intensities(source.intensities->up, grown, field.iso, false), field.iso);
    if (parameters.resample) grown = resample_mask(grown, *parameters.resample);
    progress.check_cancelled();
    field.image = masked_intensities(field.image, grown, field.iso, false);
    return field;
}

/// The mask's wall, moved by the image; opening and closing are of the mask.
Field wall_field(ImageSource& source, const ExtractionParameters& parameters, Extraction& result,
                 const Progress& progress) {
    const Image mask = chosen_mask(*source.mask, parameters, result, progress.part(0.0, 0.1));
    ExtractionParameters of_image = parameters;
    of_image.cleaning.opening = of_image.cleaning.closing = 0;
    const Intensities& made = prepared(source, of_image, false, progress.part(0.1, 0.2));
    result.contrast = made.contrast;
    const bool lumen = parameters.mask_surface == MaskSurface::Lumen;
    result.mask_surface = lumen ? MaskSurface::Lumen : MaskSurface::Smooth;
    const Image whole =
        lumen ? lumen_mask(mask, parameters, result, progress.part(0.2, 0.3)) : mask;
    const Image smooth = smooth_field(whole, parameters, result, progress.part(0.3, 0.7));
    DrawnWall wall = drawn_wall(made.ready, whole, smooth, progress.part(0.7, 1.0));
    if (lumen) wall.field = with_lumen_width(whole, wall.field, result);
    result.from_mask.emplace().seen = wall.seen;
    result.reasons.push_back(
        "the mask is the wall: moved to the image's edges by at most a voxel, " +
        formatted(100.0 * wall.seen, "%.0f") + " % of the wall has one");
    return {std::move(wall.field), 0.0, std::move(wall.mask_field)};
}

/// How far the wall lies from the mask's surface. \param seen of the result
MaskDistance distance_from(const Surface& mask, const Surface& surface, double seen) {
    const SurfaceDistance to_mask(mask);
    const std::vector<std::uint8_t> wall = vertices_of_wall(surface);
    std::vector<double> distances(surface.vertex_count());
    for_each_vertex(distances.size(), [&](std::size_t v) {
        if (wall[v] != 0) distances[v] = to_mask.closest_point(surface.points()[v]).distance;
    });
    SpreadBuilder spread;
    for (std::size_t v = 0; v < wall.size(); ++v)
        if (wall[v] != 0) spread.add(distances[v]);
    const Spread found = spread.result();
    return {.mean = found.mean, .largest = found.max, .seen = seen};
}

/// A vessel that leaves the image has at least this many voxel faces there; less is a touch.
constexpr double kSmallestCut = 2.0;

/// Area of the smallest face of a voxel [mm^2].
double smallest_face(const Image& image) {
    const Vec3 spacing = image.spacing();
    return spacing.prod() / spacing.maxCoeff();
}

void check_share(const Field& field, const Extraction& result) {
    const auto inside = std::count_if(field.image.voxels->begin(), field.image.voxels->end(),
                                      [&](float v) { return v >= static_cast<float>(field.iso); });
    if (inside > 0 && static_cast<std::size_t>(inside) < field.image.voxel_count()) return;
    auto [least, most] =
        std::minmax_element(field.image.voxels->begin(), field.image.voxels->end());
    double low = *least, high = *most;
    if (result.inside_below) {
        low = -*most;
        high = -*least;
    }
    throw DiagnosedFailure({.code = inside == 0 ? "no-voxel-inside" : "every-voxel-inside",
                            .words = {{"threshold", text_of(result.threshold)},
                                      {"least", text_of(low)},
                                      {"most", text_of(high)}},
                            .remedies = {{.arguments = {{"threshold", ""}}}}});
}

VesselBody body_of(const ExtractionParameters& parameters) {
    return {.seed = parameters.seed, .all = parameters.bodies == Bodies::All};
}

/// Intensities of a vessel, not a level set: there the iso-value is the surface.
bool has_levels(const ImageSource& source, const Extraction& result) {
    return result.method == ExtractionMethod::Masked ||
           (result.method == ExtractionMethod::Threshold &&
            source.judgement.kind != ImageKind::LevelSet);
}

/// Relative to the levels at the wall, so that one iso-value is the surface; the field itself where
/// there are none.
Field with_levels(const Field& field, const ExtractionParameters& parameters, Extraction& result,
                  const Progress& progress) {
    std::optional<LevelField> found;
    try {
        found = find_levels(field.image, field.iso, body_of(parameters), progress);
    } catch (const AlgorithmFailure& failure) {
        result.why_no_levels = failure.what();
        result.reasons.push_back("one threshold instead of a local one: " + result.why_no_levels);
        return field;
    }
    WallLevels levels = found->wall;
    if (result.inside_below) {
        std::swap(levels.lowest, levels.highest);
        levels.lowest = -levels.lowest;
        levels.highest = -levels.highest;
    }
    result.levels = levels;
    result.reasons.push_back("local thresholds at the wall from " + formatted(levels.lowest) +
                             " to " + formatted(levels.highest) +
                             ": what the image's blur leaves of the vessel's contrast there");
    std::vector<float> voxels = *field.image.voxels;
    for (std::size_t v = 0; v < voxels.size(); ++v)
        voxels[v] += static_cast<float>(field.iso) - (*found->levels.voxels)[v];
    Field result_field = field;
    result_field.image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result_field;
}

/// Intensities and the threshold, with decisions and reasons.
Field intensity_field(ImageSource& source, const ExtractionParameters& parameters,
                      Extraction& result, const Progress& progress) {
    return result.method == ExtractionMethod::Masked
               ? masked_field(source, parameters, result, progress)
               : threshold_field(source, parameters, result, progress);
}

/// What the parameters ask for, with decisions and reasons.
Field field_of(ImageSource& source, const ExtractionParameters& parameters, Extraction& result,
               const Progress& progress) {
    decide_method(source, parameters, result, progress);
    progress.check_cancelled();
    if (result.method == ExtractionMethod::Wall) {
        result.threshold = kMaskIso;
        return wall_field(source, parameters, result, progress);
    }
    if (result.method != ExtractionMethod::Labels) {
        const Field field = intensity_field(source, parameters, result, progress.part(0.0, 0.3));
        if (!parameters.local_levels || !has_levels(source, result)) return field;
        return with_levels(field, parameters, result, progress.part(0.3, 1.0));
    }
    // With both, the labels are the mask's: the image holds intensities.
    Field field =
        label_field(source.mask ? *source.mask : source.image, parameters, result, progress);
    result.threshold = kMaskIso;
    result.inside_below = false;
    return field;
}

void choose_body(const Field& field, const ExtractionParameters& parameters, Extraction& result,
                 const Progress& progress) {
    const Surface all = iso_surface(field.image, field.iso, false, progress.part(0.6, 0.8));
    progress.report(0.8, "choosing the body");
    constexpr double kSeedTolerance = 2.0;  // voxels
    ShellChoice choice =
        parameters.seed
            ? body_at(all, *parameters.seed, kSeedTolerance * field.image.spacing().maxCoeff())
        : parameters.bodies == Bodies::Largest ? largest_body(all)
                                               : all_bodies(all);
    progress.report(0.9, "choosing the body");
    result.surface = with_separate_cuts(choice.surface, kSmallestCut * smallest_face(field.image));
    if (result.between_slices == BetweenSlices::Straight)
        result.sampling = sampling_of(field.image);
    result.bodies = choice.bodies;
    result.hollows = choice.hollows;
    result.largest_dropped = choice.largest_dropped;
    result.dropped_vessel = choice.dropped_vessel;
}

/// Where a mask was used beside the image.
void add_distance(const Field& field, const ImageSource& source,
                  const ExtractionParameters& parameters, Extraction& result) {
    if (!uses_both(result.method) || result.surface.empty()) return;
    const Surface mask =
        field.of_mask ? iso_surface(*field.of_mask, 0.0)
                      : iso_surface(mask_of_labels(*source.mask, parameters.labels), kMaskIso);
    if (mask.empty()) return;
    const double seen = result.from_mask ? result.from_mask->seen : 0.0;
    result.from_mask = distance_from(mask, result.surface, seen);
}

}  // namespace

namespace {

/// Levels are found in so many within the time that a surface takes.
constexpr std::size_t kSampledVoxels = std::size_t{1} << 18;

}  // namespace

bool takes_voxels(ExtractionMethod method) {
    return method == ExtractionMethod::Labels || method == ExtractionMethod::Wall;
}

std::string to_string(ExtractionMethod method) {
    switch (method) {
        case ExtractionMethod::Labels:
            return "labels";
        case ExtractionMethod::Masked:
            return "masked";
        case ExtractionMethod::Wall:
            return "wall";
        default:
            return "threshold";
    }
}

struct SurfaceExtractor::Source : ImageSource {};

SurfaceExtractor::SurfaceExtractor(Image image, std::optional<Image> mask) {
    check(image, mask);
    ImageJudgement judgement = judge(image);
    source_ = std::make_unique<Source>(
        Source{{std::move(image), std::move(mask), std::move(judgement), {}, {}}});
}

SurfaceExtractor::~SurfaceExtractor() = default;
SurfaceExtractor::SurfaceExtractor(SurfaceExtractor&&) noexcept = default;

ExtractionParameters SurfaceExtractor::decided(ExtractionParameters parameters,
                                               const Progress& progress) {
    Extraction result;
    decide_method(*source_, parameters, result, progress);
    progress.check_cancelled();
    parameters.method = result.method;
    if (takes_voxels(result.method)) return parameters;
    if (result.method == ExtractionMethod::Masked && !parameters.threshold)
        result.threshold = masked_threshold(
            source_->image, mask_of_labels(*source_->mask, parameters.labels), progress);
    parameters.threshold = result.threshold;
    parameters.inside_below = result.inside_below;
    parameters.local_levels = parameters.local_levels && has_levels(*source_, result);
    return parameters;
}

Extraction SurfaceExtractor::extract(const ExtractionParameters& parameters,
                                     const Progress& progress) {
    progress.report(0.0, "classifying the image");
    Extraction result;
    const Field field = field_of(*source_, parameters, result, progress.part(0.1, 0.6));
    check_share(field, result);
    progress.check_cancelled();
    if (wants_topology(parameters)) result.after = voxel_topology(field.image, field.iso);
    choose_body(field, parameters, result, progress);
    add_distance(field, *source_, parameters, result);
    return result;
}

std::optional<double> SurfaceExtractor::volume_error(const ExtractionParameters& parameters,
                                                     const Progress& progress) {
    Extraction result;
    decide_method(*source_, parameters, result, progress);
    if (!has_levels(*source_, result)) return std::nullopt;
    const Field field = intensity_field(*source_, parameters, result, progress.part(0.0, 0.3));
    try {
        return volume_at_threshold(field.image, field.iso, body_of(parameters), kSampledVoxels,
                                   progress.part(0.3, 1.0)) -
               1.0;
    } catch (const AlgorithmFailure&) {
        return std::nullopt;
    }
}

Extraction extract_surface(const Image& image, const std::optional<Image>& mask,
                           const ExtractionParameters& parameters, const Progress& progress) {
    return SurfaceExtractor(image, mask).extract(parameters, progress);
}

}  // namespace vesselbench
