#include "meshing/remeshing/remesh_rounds.h"

#include <algorithm>

#include "meshing/remeshing/improve_worst.h"

namespace vesselbench {

namespace {

/// In the first round edges are split well below the target length [-]: the following collapses
/// then remove the pattern of a coarse source.
constexpr double kFirstSplit = 0.8;

/// While the mesh is still settling, edges are split earlier than later on [-].
constexpr double kEarlySplit = 1.2;
constexpr int kEarlyRounds = 4;

constexpr int kFinalRounds = 5;  // of flip and relax: sizes have settled, angles follow
/// Polishing visits this many triangles in total, but each at least twice: small meshes, with a
/// larger fraction of rims, need it most and can afford it.
constexpr std::size_t kPolishBudget = 20000;
constexpr int kFewestPolishRounds = 2, kMostPolishRounds = 8;

constexpr double kQuality = 0.5;  // below it a triangle is improved individually

/// Angles, once the sizes have settled.
Surface finished(Remesher& remesher, const Progress& progress) {
    for (int round = 0; round < kFinalRounds; ++round) {
        progress.report(0.4 * round / kFinalRounds, "improving triangles");
        remesher.flip_edges(Remesher::FlipRule::Angle);
        remesher.relax(Remesher::RelaxRule::Shape);
    }
    const int polish_rounds = std::clamp(
        static_cast<int>(kPolishBudget / std::max<std::size_t>(remesher.mesh.triangle_count(), 1)),
        kFewestPolishRounds, kMostPolishRounds);
    for (int round = 0; round < polish_rounds; ++round) {
        progress.report(0.4 + 0.4 * round / polish_rounds, "improving triangles");
        polish(remesher);
    }
    progress.report(0.8, "improving triangles");
    improve_worst(remesher, kQuality);
    remesher.keep_volume();
    return remesher.result();
}

double split_limit(int round) {
    return round == 0 ? kFirstSplit : round < kEarlyRounds ? kEarlySplit : Remesher::kLong;
}

/// \param first earlier rounds are left out
void run_rounds(Remesher& remesher, int first, int rounds, const Progress& progress) {
    remesher.collapse_short_edges();  // before needles are split into many short edges
    for (int round = first; round < rounds; ++round) {
        const auto report = [&](double of_round) {
            progress.report((round - first + of_round) / (rounds - first), "remeshing");
        };
        report(0.0);
        remesher.split_long_edges(split_limit(round));
        report(0.3);
        remesher.collapse_short_edges();
        if (round >= 2 && round + 2 < rounds)
            remesher.collapse_defects();  // sizes have settled, and settle again
        report(0.6);
        remesher.flip_edges(Remesher::FlipRule::Valence);
        remesher.relax(Remesher::RelaxRule::Size);
        report(0.8);
        remesher.relax(Remesher::RelaxRule::Shape);
    }
}

}  // namespace

Surface remeshed(Remesher& remesher, int first_round, const Progress& progress) {
    run_rounds(remesher, first_round, kRemeshRounds, progress.part(0.0, 0.8));
    return finished(remesher, progress.part(0.8, 1.0));
}

}  // namespace vesselbench
