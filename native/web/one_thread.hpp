// The locks and threads of the standard library for a target that has one thread and whose standard library
// therefore has none of them. Included before all else in every source of the module for browsers
// (CMakeLists.txt).
#pragma once
#include <mutex>
#include <shared_mutex>
#include <system_error>
#include <thread>

#if _LIBCPP_HAS_THREADS
#error "This standard library has threads of its own"
#endif

namespace std {

/// Nobody else can hold it.
class mutex {
  public:
    void lock() noexcept {}
    bool try_lock() noexcept { return true; }
    void unlock() noexcept {}
};

class shared_mutex : public mutex {
  public:
    void lock_shared() noexcept {}
    void unlock_shared() noexcept {}
};

template <class Mutex>
class [[nodiscard]] scoped_lock {
  public:
    explicit scoped_lock(Mutex&) noexcept {}
    scoped_lock(const scoped_lock&) = delete;
    scoped_lock& operator=(const scoped_lock&) = delete;
};

template <class Mutex>
class [[nodiscard]] shared_lock {
  public:
    explicit shared_lock(Mutex&) noexcept {}
    shared_lock(const shared_lock&) = delete;
    shared_lock& operator=(const shared_lock&) = delete;
};

/// The system gives no threads beside the one that there is.
class thread {
  public:
    template <class Work>
    explicit thread(Work&&) {
        throw system_error(make_error_code(errc::resource_unavailable_try_again));
    }
    void join() noexcept {}
    static unsigned hardware_concurrency() noexcept { return 1; }
};

}  // namespace std
