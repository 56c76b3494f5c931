#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>
#include <typeindex>
#include <typeinfo>
#include <utility>

#include "geometry/kernel/content_key.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// What is derived from surfaces and costs more than looking it up: distance trees, one-rings,
/// centerline graphs, curvature, self-intersections. Keyed by content: the same arrays find it
/// wherever they lie in memory, and a changed vertex does not. Holds what was used last within a
/// number of bytes. Thread-safe.
class DerivedCache {
public:
    static constexpr std::size_t kUsualBudget = std::size_t{512} << 20;  ///< [bytes]

    /// \param budget [bytes] of all that is held; 0 keeps nothing
    explicit DerivedCache(std::size_t budget = kUsualBudget);
    ~DerivedCache();
    DerivedCache(const DerivedCache&) = delete;
    DerivedCache& operator=(const DerivedCache&) = delete;

    /// What is derived from a content: known, or made and kept. Several threads that ask for the
    /// same at once wait for the one that makes it. If that one throws, its caller gets the
    /// exception, nothing is kept, and one of those that wait makes it in its place; so a cancelled
    /// caller takes nothing from the others.
    /// \param kind what it is; one type may serve several kinds
    /// \param key of everything that it depends on
    /// \param make () -> T, pure in `key`; must not ask for the same kind and key
    /// \param bytes (const T&) -> [bytes] that keeping it costs
    /// \param progress cancels the wait; what `make` reports to is its own matter
    /// \throw Cancelled while it waits; whatever `make` throws
    template <class T, class Make, class Bytes>
    [[nodiscard]] std::shared_ptr<const T> find_or_make(std::string_view kind,
                                                        const ContentKey& key, const Make& make,
                                                        const Bytes& bytes,
                                                        const Progress& progress = {}) {
        const auto make_sized = [&]() -> Sized {
            auto made = std::make_shared<const T>(make());
            const std::size_t size = bytes(*made);
            return {std::move(made), size};
        };
        return std::static_pointer_cast<const T>(
            find_or_make({typeid(T), kind, key}, make_sized, progress));
    }

    /// Key of positions and triangles. What a shared array holds is read once, then remembered as
    /// long as the array lives.
    /// \throw InvalidInput if the surface has no triangle
    [[nodiscard]] ContentKey shape_key(const Surface& surface);

    /// Key of positions, triangles, patch labels and the patch table.
    /// \throw InvalidInput if the surface has no triangle
    [[nodiscard]] ContentKey surface_key(const Surface& surface);

    /// [bytes] currently held
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] std::size_t size() const;

    /// Drops what was not used for longest where the new budget asks for it.
    void set_budget(std::size_t budget);

    /// Drops everything that is held; what callers still hold lives on.
    void clear();

private:
    struct Key {
        std::type_index type;
        std::string_view kind;
        ContentKey content;

        auto operator<=>(const Key&) const = default;
    };

    struct Sized {
        std::shared_ptr<const void> value;
        std::size_t bytes = 0;
    };

    struct Parts;

    [[nodiscard]] std::shared_ptr<const void> find_or_make(const Key& key,
                                                           const std::function<Sized()>& make,
                                                           const Progress& progress);

    std::unique_ptr<Parts> parts_;
};

/// Key of positions and triangles, read each time: that of a surface that holds the same.
[[nodiscard]] ContentKey shape_key(const Topology& topology, const Positions& positions);
[[nodiscard]] ContentKey shape_key(const Positions& positions, std::span<const Triangle> triangles);

/// The one that functions of surfaces share when they are given no other. What is derived is a pure
/// function of its content, so nobody can see who made it; see docs/decisions.md.
[[nodiscard]] DerivedCache& derived_cache();

}  // namespace vesselbench
