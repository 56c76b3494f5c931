#include "geometry/kernel/derived_cache.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <list>
#include <map>
#include <mutex>

#include <tbb/task_arena.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// How long a cancelled waiter may keep waiting.
constexpr std::chrono::milliseconds kLookAround{20};

/// Keys of shared arrays, so that each is hashed once. An array's address may be reused once the
/// array is gone, its control block's may not while a weak pointer to it is kept.
class ArrayKeys {
public:
    ContentKey key_of(const std::shared_ptr<const void>& array,
                      const std::function<ContentKey()>& hash) {
        {
            const std::lock_guard lock(mutex_);
            if (const auto found = keys_.find(array); found != keys_.end()) return found->second;
        }
        const ContentKey key = hash();  // without the lock: others need not wait
        const std::lock_guard lock(mutex_);
        if (keys_.size() >= limit_) drop_gone();
        keys_.emplace(array, key);
        return key;
    }

private:
    void drop_gone() {
        std::erase_if(keys_, [](const auto& entry) { return entry.first.expired(); });
        limit_ = std::max(kFewest, 2 * keys_.size());
    }

    static constexpr std::size_t kFewest = 64;

    std::mutex mutex_;
    std::map<std::weak_ptr<const void>, ContentKey, std::owner_less<>> keys_;
    std::size_t limit_ = kFewest;
};

}  // namespace

struct DerivedCache::Parts {
    struct Entry {
        Key key;
        Sized made;
    };

    using Place = std::list<Entry>::iterator;

    explicit Parts(std::size_t most) : budget(most) {}

    std::shared_ptr<const void> find(const Key& key) {
        const auto found = places.find(key);
        if (found == places.end()) return nullptr;
        entries.splice(entries.begin(), entries, found->second);
        return found->second->made.value;
    }

    /// Moves entries beyond the budget to `dropped`, which the caller frees without the lock.
    void shrink_to(std::size_t most, std::list<Entry>& dropped) {
        while (total > most) {
            total -= entries.back().made.bytes;
            places.erase(entries.back().key);
            dropped.splice(dropped.end(), entries, std::prev(entries.end()));
        }
    }

    void keep(const Key& key, const Sized& made, std::list<Entry>& dropped) {
        if (made.bytes > budget || places.contains(key)) return;
        shrink_to(budget - made.bytes, dropped);
        entries.push_front({key, made});
        places.emplace(key, entries.begin());
        total += made.bytes;
    }

    mutable std::mutex mutex;
    std::condition_variable over;  ///< an entry is no longer in the making
    std::size_t budget;
    std::size_t total = 0;
    std::list<Entry> entries;  ///< most recently used first
    std::map<Key, Place> places;
    /// Entries in the making: each maker's slot for its result, shared with those that wait, so
    /// that they get it even if it is too large to keep.
    std::map<Key, std::shared_ptr<std::shared_ptr<const void>>> making;
    ArrayKeys array_keys;
};

DerivedCache::DerivedCache(std::size_t budget) : parts_(std::make_unique<Parts>(budget)) {}

DerivedCache::~DerivedCache() = default;

std::shared_ptr<const void> DerivedCache::find_or_make(const Key& key,
                                                       const std::function<Sized()>& make,
                                                       const Progress& progress) {
    Parts& parts = *parts_;
    const auto result = std::make_shared<std::shared_ptr<const void>>();
    std::list<Parts::Entry> dropped;  // freed last, without the lock
    {
        std::unique_lock lock(parts.mutex);
        for (;;) {
            if (auto known = parts.find(key)) return known;
            const auto [maker, first] = parts.making.try_emplace(key, result);
            if (first) break;
            const auto theirs = maker->second;
            const auto still = [&] {
                const auto now = parts.making.find(key);
                return now != parts.making.end() && now->second == theirs;
            };
            while (still()) {
                parts.over.wait_for(lock, kLookAround);
                progress.check_cancelled();
            }
            if (*theirs) return *theirs;
        }
    }
    const auto finish = [&](const Sized& made) {
        const std::lock_guard lock(parts.mutex);
        *result = made.value;
        if (made.value) parts.keep(key, made, dropped);
        parts.making.erase(key);
        parts.over.notify_all();
    };
    try {
        // While it waits for its own tasks, this thread must not take up one that requests the same
        // key.
        const Sized made = tbb::this_task_arena::isolate(make);
        finish(made);
        return made.value;
    } catch (...) {
        finish({});
        throw;
    }
}

ContentKey DerivedCache::key_of(const std::shared_ptr<const void>& array,
                                const std::function<ContentKey()>& hash) {
    return parts_->array_keys.key_of(array, hash);
}

std::size_t DerivedCache::bytes() const {
    const std::lock_guard lock(parts_->mutex);
    return parts_->total;
}

std::size_t DerivedCache::size() const {
    const std::lock_guard lock(parts_->mutex);
    return parts_->entries.size();
}

void DerivedCache::set_budget(std::size_t budget) {
    std::list<Parts::Entry> dropped;
    const std::lock_guard lock(parts_->mutex);
    parts_->budget = budget;
    parts_->shrink_to(budget, dropped);
}

void DerivedCache::clear() {
    std::list<Parts::Entry> dropped;
    const std::lock_guard lock(parts_->mutex);
    dropped.swap(parts_->entries);
    parts_->places.clear();
    parts_->total = 0;
}

DerivedCache& derived_cache() {
    // It outlives users during program exit.
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
    static DerivedCache& cache = *new DerivedCache;
    return cache;
}

}  // namespace vesselbench
