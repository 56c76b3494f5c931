// The figures of a sac, for scripts/experiments_sacs.py.
//
//   sacs SURFACE X Y Z   prints the figures of the sac of a file in mm that has its dome there, as
//                        JSON; where no neck is found, the reason

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/vessel/repair/repair.h"
#include "geometry/vessel/sac/neck_plane.h"
#include "geometry/vessel/sac/sac_measures.h"

namespace vesselbench {

namespace {

nlohmann::ordered_json figures(const std::string& file, const Vec3& dome) {
    const Surface surface = repair(read_surface(file).surface).surface;
    try {
        const SacAtNeck neck = propose_neck(surface, dome);
        const SacMeasures m = measure_sac(neck.sac, neck.parent_diameter);
        return {{"neck_diameter_mm", m.neck_diameter},
                {"height_mm", m.height},
                {"length_mm", m.length},
                {"in_doubt", neck_in_doubt(m)}};
    } catch (const AlgorithmFailure& failure) {
        return {{"reason", failure.what()}};
    }
}

}  // namespace

}  // namespace vesselbench

int main(int count, char** words) {
    if (count != 5) return std::fputs("usage: sacs SURFACE X Y Z\n", stderr), 2;
    try {
        const vesselbench::Vec3 dome(std::atof(words[2]), std::atof(words[3]), std::atof(words[4]));
        std::cout << vesselbench::figures(words[1], dome) << "\n";
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
    return 0;
}
