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

namespace vesselbench {

/// A cache of data derived from surfaces: distance trees, one-rings, centerline graphs, curvature,
/// self-intersections. Keyed by content: equal arrays hit wherever they lie in memory; one moved
/// vertex is a miss. Keeps the most recently used entries within a budget of bytes. Thread-safe.
class DerivedCache {
public:
    static constexpr std::size_t kUsualBudget = std::size_t{512} << 20;  ///< [bytes]

    /// \param budget [bytes] of all entries; 0 keeps nothing
    explicit DerivedCache(std::size_t budget = kUsualBudget);
    ~DerivedCache();
    DerivedCache(const DerivedCache&) = delete;
    DerivedCache& operator=(const DerivedCache&) = delete;

    /// The entry of a key, made if it is not there yet. Threads that request the same entry at once
    /// wait for the one that makes it. If that one throws, its caller gets the exception, nothing
    /// is kept, and a waiting thread makes the entry instead: a cancelled caller does not affect
    /// the others.
    /// \param kind of entry; one type may serve several kinds
    /// \param key of everything it depends on
    /// \param make () -> T, pure in `key`; must not ask for the same kind and key
    /// \param bytes (const T&) -> [bytes] it takes
    /// \param progress cancels the wait; it is not passed to `make`
    /// \throw Cancelled while waiting; whatever `make` throws
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

    /// The key of a shared array, which is hashed once; the key is kept as long as the array lives.
    /// \param hash of the array's content
    [[nodiscard]] ContentKey key_of(const std::shared_ptr<const void>& array,
                                    const std::function<ContentKey()>& hash);

    /// [bytes] currently held
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] std::size_t size() const;

    /// Sets the budget and drops the least recently used entries beyond it.
    void set_budget(std::size_t budget);

    /// Drops all entries; those still held by callers live on.
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

/// The cache that functions of surfaces use unless given another. Entries are pure functions of
/// their keys, so sharing them changes no result; see docs/dev/decisions.md.
[[nodiscard]] DerivedCache& derived_cache();

}  // namespace vesselbench
