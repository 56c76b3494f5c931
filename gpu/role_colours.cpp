#include "gpu/role_colours.h"

namespace vesselbench {

Colour role_colour(ShownRole role) {
    switch (role) {
        case ShownRole::Inlet:
            return {0.15F, 0.55F, 0.12F};
        case ShownRole::Outlet:
            return {0.10F, 0.28F, 0.62F};
        case ShownRole::Closed:
            return {0.40F, 0.05F, 0.65F};
        case ShownRole::Sac:
            break;
    }
    return {0.70F, 0.10F, 0.35F};
}

}  // namespace vesselbench
