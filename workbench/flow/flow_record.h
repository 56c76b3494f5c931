#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/vessel/sac/neck_plane.h"
#include "meshing/products/cfd_parameters.h"
#include "meshing/tetrahedra/volume_mesh.h"
#include "workbench/session/source_counterpart.h"

namespace vesselbench {

/// An opening of a solver's case.
struct RecordedOpening {
    std::string name;  ///< of the patch in the case
    PatchKind kind = PatchKind::Outlet;
    double area = 0.0;                              ///< [mm^2]
    double diameter = 0.0;                          ///< of a disc of that area [mm]
    std::optional<double> flow = std::nullopt;      ///< given, of an inlet [cm^3/s]
    std::optional<double> reynolds = std::nullopt;  ///< of an inlet [-]
};

/// The neck of the model's sac, for figures by region (sac_regions).
struct RecordedNeck {
    SacNeck neck;
    double reach = 1.0;                        ///< as of SacRegionOptions
    std::optional<Vec3> inlet = std::nullopt;  ///< [mm]
};

/// What a pulsatile flow follows.
struct RecordedWaveform {
    bool synthetic = false;  ///< of no measurement
    double period = 0.0;     ///< [s]
    int periods = 0;         ///< computed; the last one counts
    int steps = 0;           ///< of time in a period

    [[nodiscard]] int all_steps() const { return periods * steps; }
};

/// Where a solver's case comes from.
struct FlowOrigin {
    std::string provenance = {};                      ///< of the model; empty: not known
    std::vector<MadeEnd> ends = {};                   ///< where the vessel was cut and extended
    std::optional<RecordedNeck> neck = std::nullopt;  ///< none: no sac is marked
};

/// What a solver's case is of: flow.json in its folder, for whoever runs it or reads its results.
struct FlowRecord {
    std::string provenance;  ///< of the model; empty: not known
    std::string mesh;        ///< SHA-256 of the mesh's files
    std::size_t cells = 0;
    Bounds bounds;                  ///< [mm]
    double density = 0.0;           ///< [kg/m^3]
    double viscosity = 0.0;         ///< dynamic; of Carreau's model that of high shear rates [Pa s]
    bool carreau = false;           ///< viscosity depends on the shear rate
    bool given_outflows = false;    ///< through all outlets but one; else one pressure at all
    std::string outflow_rule = {};  ///< how they were given, as outlets_text(); empty: not known
    bool parabolic = true;          ///< profile at the inlets; else plug
    std::vector<std::string> walls;  ///< names of the patches
    std::vector<RecordedOpening> openings;
    /// Where the vessel was cut and extended: beyond them, the wall is not its own. Empty: not
    /// known.
    std::vector<MadeEnd> ends;
    std::optional<RecordedNeck> neck = std::nullopt;          ///< none: no sac is marked
    std::optional<RecordedWaveform> waveform = std::nullopt;  ///< none: the flow is steady

    /// Of the solver's time: an iteration, or a step of time [s].
    [[nodiscard]] double step() const {
        return waveform ? waveform->period / waveform->steps : 1.0;
    }

    /// The number of iterations, or of steps until a time folder.
    [[nodiscard]] int steps_until(double time) const;

    /// The iterations at the end whose mean counts: a period's steps, or the last one.
    [[nodiscard]] std::size_t counted_steps() const {
        return waveform ? static_cast<std::size_t>(waveform->steps) : 1;
    }
};

/// Writes flow.json into the folder of a case, which is complete otherwise.
/// \throw IoError, AlgorithmFailure as flow_summary()
void write_flow_record(const std::filesystem::path& folder, const VolumeMesh& mesh,
                       const CfdParameters& parameters, const FlowOrigin& origin);

/// \throw InvalidInput if the case has none, or a damaged one
[[nodiscard]] FlowRecord read_flow_record(const std::filesystem::path& folder);

/// \throw InvalidInput unless the case's mesh is the one that it was written with
void require_recorded_mesh(const std::filesystem::path& folder, const FlowRecord& record);

}  // namespace vesselbench
