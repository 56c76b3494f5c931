#pragma once

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// What a surface was made from.
enum class SurfaceOrigin { Intensities, Mask, File };

/// Refuses what has no lumen before anything long is tried on it: a sheet, whose thickness is
/// nothing beside its extent, and noise, a sponge of loops.
/// \throw InvalidInput; the text says which it is, with its figures and what may help such a source
void require_lumen(const Surface& surface, SurfaceOrigin source = SurfaceOrigin::Intensities);

/// Refuses as a model for a flow what encloses more than a heart with the great vessels: the body
/// or an organ of an image without a mask.
/// \throw InvalidInput; the text says what may help such a source
void require_vessel_size(const Surface& surface, SurfaceOrigin source = SurfaceOrigin::Intensities);

/// True if a branch is a tube: longer than 1.5 of its widest diameters, without its furcations. An
/// organ or a box has centerlines, too, but none that long.
[[nodiscard]] bool has_tube(const CenterlineGraph& graph);

}  // namespace vesselbench
