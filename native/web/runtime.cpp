// The memory that JavaScript writes arguments to, and what becomes of an argument that the library refuses:
// the exception's text is thrown by JavaScript, and ends the call. Nothing on the way is destroyed, so that
// what it holds is lost until the page is closed, and nothing catches it.
#include <cstdlib>
#include <exception>
#include <typeinfo>
#include <vector>

extern "C" {

/// Throws an Error in JavaScript; the text is UTF-8 that ends with a zero.
[[noreturn]] __attribute__((import_module("motus"), import_name("refuse"))) void motus_refuse(
    const char* text);

/// Room for so many doubles, until the next call.
__attribute__((export_name("room"))) double* motus_room(std::size_t count) {
    static std::vector<double> room;
    room.resize(count);
    return room.data();
}

// What a compiler calls for `throw`. All that the library throws is a std::exception first of all.
void* __cxa_allocate_exception(std::size_t size) noexcept {
    return std::malloc(size);
}
[[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
    motus_refuse(static_cast<std::exception*>(thrown)->what());
}

}  // extern "C"
