#pragma once

#include <memory>
#include <span>

#include "geometry/phantoms/description.h"

namespace vesselbench {

/// The implicit function of a phantom: negative inside, zero on the surface, in [mm]; near the
/// surface it approximates the signed distance. Fillets are polynomial smooth minima (Quilez,
/// "Smooth minimum", 2013).
class PhantomField {
public:
    /// \throw InvalidInput if there is no part, or a part's sizes are not positive
    explicit PhantomField(std::span<const PhantomPart> parts);
    ~PhantomField();
    PhantomField(PhantomField&&) noexcept;
    PhantomField& operator=(PhantomField&&) noexcept;

    [[nodiscard]] double operator()(const Vec3& p) const;

    /// The function of one part alone. \throw InvalidInput if there is no part of this name
    [[nodiscard]] double part(const std::string& name, const Vec3& p) const;

    /// Gradient by central differences.
    [[nodiscard]] Vec3 gradient(const Vec3& p) const;

    /// A box that contains the surface [mm].
    [[nodiscard]] Eigen::AlignedBox3d bounds() const;

private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

}  // namespace vesselbench
