#pragma once

#include <string>

#include "geometry/formats/format.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The format of centerlines, a row like those of surfaces and images.
[[nodiscard]] const Format& centerline_format();

/// \throw UsageError unless write_centerlines can write a file of this name
void check_centerline_name(const std::string& path);

/// Writes a centerline graph as a VTP file in mm, completely or not at all: one polyline per
/// branch. Point arrays: `MaximumInscribedSphereRadius` [mm], `Abscissas` [mm] from the branch's
/// start, `BranchId`. Cell arrays: `CenterlineIds`, `TractIds`, `GroupIds`, `Blanking` as in VMTK
/// after branch extraction (one tract and one group per branch, none blanked), `StartNodeIds`,
/// `EndNodeIds` (equal numbers meet), `Length` [mm].
/// \throw UsageError for another suffix, IoError if the file cannot be written, InvalidInput if the
/// graph has no branch
void write_centerlines(const CenterlineGraph& graph, const std::string& path);

/// Reads a VTP file written by vesselbench or VMTK: one branch per polyline. Without node numbers,
/// line ends at the same place (to a millionth of the extent) become one node. Radii come from
/// `MaximumInscribedSphereRadius` or `Radius`; without either they are 0.
/// \throw IoError if the file cannot be read, InvalidInput if it contains no line
[[nodiscard]] CenterlineGraph read_centerlines(const std::string& path);

}  // namespace vesselbench
