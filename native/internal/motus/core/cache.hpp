// Bounded, thread-safe cache for tables that are expensive to build.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/cache_budget.hpp"

namespace motus {

/// Hash of a key's numbers, for a Cache. Equal bits give equal hashes.
class ContentHash {
  public:
    void add(std::uint64_t value) noexcept {
        state_ = (state_ ^ value) * 0x9e3779b97f4a7c15ULL;
        state_ ^= state_ >> 32;
    }
    void add(double value) noexcept { add(std::bit_cast<std::uint64_t>(value)); }
    void add(std::span<const double> values) noexcept {
        for (const double value : values) add(value);
    }
    void add(std::span<const glm::dvec3> values) noexcept {
        for (const glm::dvec3& v : values) {
            add(v.x);
            add(v.y);
            add(v.z);
        }
    }
    [[nodiscard]] std::size_t value() const noexcept { return static_cast<std::size_t>(state_); }

  private:
    std::uint64_t state_ = 0x243f6a8885a308d3ULL;
};

/// Bytes that a vector has allocated.
template <class T>
[[nodiscard]] std::size_t bytes_of(const std::vector<T>& values) noexcept {
    return values.capacity() * sizeof(T);
}

/// Keeps the most recently used values: `capacity` of them at most, and only as many as have room in the
/// budget that it shares with other caches. A value is found by the whole content of its key (Key needs ==;
/// the hash only narrows the search) and is a function of that key: an answer does not depend on which values
/// are in the cache.
///
/// Bytes{}(key, value) is the size of an entry. The sizes are asked again whenever an entry is added, since a
/// value may build a part of itself later; with more than 64 entries once per 64th part of them that is
/// added.
template <class Key, class Value, class Hash, class Bytes>
class Cache final : CacheBudget::Member {
  public:
    using Pointer = std::shared_ptr<const Value>;

    explicit Cache(std::size_t capacity, CacheBudget& budget = process_budget())
        : Member(budget), capacity_(capacity) {
        join();
    }
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;
    Cache(Cache&&) = delete;
    Cache& operator=(Cache&&) = delete;
    ~Cache() { leave(); }

    /// The value of `key`; if there is none, `make(key)` -> shared_ptr<const Value> builds it. Built
    /// outside the lock, so that threads with different keys don't wait for each other; if two build the
    /// same, the first stays. If this throws, the cache is as it was.
    template <class Make>
    [[nodiscard]] Pointer get(const Key& key, Make&& make) {
        const std::size_t hash = Hash{}(key);
        {
            const std::scoped_lock lock(mutex_);
            if (Pointer held = find(hash, key)) return held;
        }
        Pointer made = std::forward<Make>(make)(key);
        Pointer kept = keep(hash, key, std::move(made));
        budget().enforce();
        return kept;
    }

    /// The value of `key`, or null if there is none.
    [[nodiscard]] Pointer held(const Key& key) {
        const std::size_t hash = Hash{}(key);
        const std::scoped_lock lock(mutex_);
        return find(hash, key);
    }

    /// Drops the entries whose key satisfies `is_unwanted(key)`. Looks through all entries.
    template <class IsUnwanted>
    void erase_if(const IsUnwanted& is_unwanted) {
        Entries dropped;  // freed when the lock is
        const std::scoped_lock lock(mutex_);
        for (auto entry = entries_.begin(); entry != entries_.end();) {
            const auto next = std::next(entry);
            if (is_unwanted(std::as_const(entry->key))) {
                forget(entry);
                dropped.splice(dropped.begin(), entries_, entry);
            }
            entry = next;
        }
    }

    /// Sets the greatest number of entries; 0 switches the cache off.
    void set_capacity(std::size_t capacity) {
        const std::scoped_lock lock(mutex_);
        capacity_ = capacity;
        shrink();
    }
    /// Greatest number of entries.
    [[nodiscard]] std::size_t capacity() const {
        const std::scoped_lock lock(mutex_);
        return capacity_;
    }
    /// Number of entries at this moment.
    [[nodiscard]] std::size_t size() const {
        const std::scoped_lock lock(mutex_);
        return entries_.size();
    }
    /// Sum of all entries' sizes at this moment.
    [[nodiscard]] std::size_t bytes() const {
        const std::scoped_lock lock(mutex_);
        std::size_t sum = 0;
        for (const Entry& entry : entries_) sum += Bytes{}(entry.key, *entry.value);
        return sum;
    }

  private:
    struct Entry {
        std::size_t hash;
        Key key;
        Pointer value;
        std::size_t bytes;   ///< size of the entry when it was last asked
        std::uint64_t used;  ///< when it was last asked for, by the budget's clock
    };
    using Entries = std::list<Entry>;

    [[nodiscard]] std::uint64_t oldest() override {
        const std::scoped_lock lock(mutex_);
        return entries_.empty() ? CacheBudget::never : entries_.back().used;
    }

    [[nodiscard]] std::shared_ptr<const void> drop_oldest() noexcept override {
        const std::scoped_lock lock(mutex_);
        return entries_.empty() ? nullptr : drop_last();
    }

    /// Adds a value; returns it, or that which another thread has added in the meantime.
    [[nodiscard]] Pointer keep(std::size_t hash, const Key& key, Pointer made) {
        const std::scoped_lock lock(mutex_);
        if (Pointer held = find(hash, key)) return held;
        // What may throw comes before the splice, which cannot, and which keeps the iterator.
        Entries added;
        added.push_front({hash, key, made, Bytes{}(key, *made), now()});
        index_.emplace(hash, added.begin());
        entries_.splice(entries_.begin(), added);
        take(taken() + entries_.front().bytes);
        if (++added_ > entries_.size() / 64) measure();
        shrink();
        return made;
    }

    /// The value of a key, which becomes the most recently used one, or null.
    [[nodiscard]] Pointer find(std::size_t hash, const Key& key) {
        const auto [first, last] = index_.equal_range(hash);
        for (auto it = first; it != last; ++it) {
            if (!(it->second->key == key)) continue;
            entries_.splice(entries_.begin(), entries_, it->second);
            it->second->used = now();
            return it->second->value;
        }
        return nullptr;
    }

    void measure() {
        added_ = 0;
        std::size_t sum = 0;
        for (Entry& entry : entries_) sum += entry.bytes = Bytes{}(entry.key, *entry.value);
        take(sum);
    }

    void forget(typename Entries::iterator entry) {
        auto it = index_.find(entry->hash);
        while (it->second != entry) ++it;
        index_.erase(it);
        take(taken() - entry->bytes);
    }

    Pointer drop_last() noexcept {
        const auto last = std::prev(entries_.end());
        forget(last);
        Pointer value = std::move(last->value);
        entries_.erase(last);
        return value;
    }

    /// Drops the least recently used entries until there are no more than `capacity_`.
    void shrink() {
        while (entries_.size() > capacity_) drop_last();
    }

    mutable std::mutex mutex_;
    std::size_t capacity_;
    Entries entries_;        ///< the most recently used first
    std::size_t added_ = 0;  ///< entries added since all sizes were asked
    std::unordered_multimap<std::size_t, typename Entries::iterator> index_;
};

}  // namespace motus
