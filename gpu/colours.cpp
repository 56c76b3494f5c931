#include <algorithm>

#include "gpu/picture.h"

namespace vesselbench {

Colour diverging_colour(double value) {
    const auto v = static_cast<float>(std::clamp(value, -1.0, 1.0));
    const Colour neutral(0.80F, 0.80F, 0.78F), high(0.70F, 0.02F, 0.03F), low(0.03F, 0.10F, 0.55F);
    return v < 0.0F ? Colour(neutral + (low - neutral) * -v)
                    : Colour(neutral + (high - neutral) * v);
}

Colour heated_colour(double value) {
    const auto v = static_cast<float>(std::clamp(value, 0.0, 1.0)) * 3.0F;
    return {std::clamp(v, 0.0F, 1.0F), std::clamp(v - 1.0F, 0.0F, 1.0F),
            std::clamp(v - 2.0F, 0.0F, 1.0F)};
}

}  // namespace vesselbench
