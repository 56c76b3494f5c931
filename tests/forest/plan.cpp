#include "tests/forest/plan.h"

#include "tests/forest/dice.h"

namespace vesselbench::forest {

Plan plan_for(std::uint64_t seed) {
    Dice dice(seed);
    Plan plan;
    plan.seed = seed;
    plan.kind = static_cast<CaseKind>(dice.pick({0.35, 0.25, 0.10, 0.15, 0.15}));
    const double u = dice.unit();
    plan.ends = 3 + static_cast<int>(57.999 * u * u);
    plan.trunk = dice.log_between(1.0, 30.0);
    plan.exponent = dice.between(2.2, 3.0);
    plan.tortuosity = dice.chance(0.3) ? 0.5 : 0.2;
    plan.loops = dice.chance(0.2) ? dice.whole(1, 3) : 0;
    plan.kisses = dice.chance(0.2) ? dice.whole(1, 2) : 0;
    plan.sacs = dice.chance(0.25) ? dice.whole(1, 3) : 0;
    plan.triangles = static_cast<int>(dice.log_between(15'000.0, 120'000.0));
    plan.anisotropy = dice.between(1.0, 5.0);
    plan.border = dice.chance(0.4);
    plan.jitter = dice.chance(0.5);
    plan.noise = dice.between(0.02, 0.10);
    return plan;
}

}  // namespace vesselbench::forest
